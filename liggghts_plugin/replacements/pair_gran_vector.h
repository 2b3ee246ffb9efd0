#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grains/contact_pass.h"
#include "pair_gran_proxy.h"

namespace LAMMPS_NS {

/// `pair_style gran` with a vectorised evaluation of the contacts.
///
/// Settings, coefficients, restart files, walls and every other interface are LIGGGHTS's own. The pass over
/// the contacts is ours where the model is one that `suffuse::grains::contact_pass` has; else it is
/// LIGGGHTS's, which the program says once with the reason. Between two neighbour lists springs live in an
/// array of our own and are brought back into LIGGGHTS's lists whenever something of LIGGGHTS's is about to
/// read them.
///
/// Own keywords, after LIGGGHTS's: `loop vector|stock`, `lost_springs drop|keep`, `normal_at
/// half_step|full_step`, `compare N`; see docs/reference/pair_style_gran.md.
class PairGranVector : public PairGranProxy {
 public:
  explicit PairGranVector(LAMMPS* lmp_in);

  void settings(int narg, char** arg) override;
  void init_granular() override;
  void compute_force(int eflag, int vflag, int addflag) override;

  /// Brings the springs of all pairs into LIGGGHTS's lists, with flags for those that touch.
  void springs_to_lists();

 private:
  /// Coefficients that LIGGGHTS keeps for each pair of types, 1 based.
  struct Properties {
    double** effective_modulus = nullptr;
    double** effective_shear_modulus = nullptr;
    double** damping = nullptr;
    double** tangential_damping = nullptr;
    double** friction = nullptr;
    double** rolling_friction = nullptr;
  };

  /// Reads one of our keywords; false if it is none of them.
  bool read_own_keyword(const std::string& keyword, const std::string& value);
  void read_option(const std::string& keyword, const std::string& value);
  std::string why_stock();
  void connect_properties();
  void tell_which_loop(const std::string& reason);

  bool can_do(int eflag, int addflag) const;
  void take_lists();
  void find_owners();
  void find_twins();
  bool is_second(std::size_t pair) const;  ///< of the two that stand for one contact
  void order_active();
  void choose_active();
  void take_springs();
  void take_coefficients();
  void take_motion();
  suffuse::grains::PassSettings pass_settings(bool advance) const;
  void force_pass(int vflag);
  void sample_pass();
  /// Passes contacts on to whoever asked, each side that LIGGGHTS lists; `histories` holds each listed pair's
  /// values.
  void tell_contacts(const std::vector<suffuse::grains::ContactNote>& notes,
                     const std::vector<double*>& histories);
  suffuse::grains::CandidatePairs active_pairs() const;
  void compare_with_stock(int eflag, int vflag);

  bool options_known_ = false;  ///< false after a restart until the script names the pair style again
  bool vector_wanted_ = true, drop_lost_springs_ = true, half_step_normal_ = true;
  bool tangential_damping_ = true, two_sevenths_ = false;
  std::string foreign_option_;
  std::int64_t compare_every_ = 0;
  std::string told_;

  bool ours_ = false;
  suffuse::InstructionSet instruction_set_;
  suffuse::grains::ContactLaw law_;
  Properties properties_;
  std::vector<suffuse::grains::PairCoefficients> coefficients_;

  // What was made of the present lists.
  bigint seen_generation_ = -1;
  bool lists_are_newer_ = true;  ///< LIGGGHTS's own loop has moved the springs since we took them
  bool springs_are_newer_ = false;
  std::vector<int> first_, second_;  ///< all pairs, in the order of the lists
  static constexpr std::uint32_t kNoTwin = ~0u;
  std::vector<std::uint32_t> twin_;  ///< the same pair, seen from the other side of a periodic face
  std::vector<suffuse::grains::Quad> springs_;  ///< of active pairs
  std::vector<int> active_first_, active_second_, active_motion_, active_receiver_;
  std::vector<std::uint32_t> active_pair_, active_of_;  ///< listed pair of an active one, and the other way
  std::vector<int> owner_;            ///< of a copy whose original is on this rank: that one; else itself
  std::vector<std::size_t> images_;   ///< copies that stand in active pairs
  std::vector<std::size_t> foreign_;  ///< those of grains of other ranks
  std::vector<double> immovable_;     ///< factor of 1 / mass, one a grain
  double pass_number_ = 0;

  std::vector<suffuse::grains::Quad> position_, velocity_, spin_;
  std::vector<int> material_;
  std::vector<suffuse::grains::Load>
      loads_;  ///< of the owned grains, zero between passes, and one for nobody
};

}  // namespace LAMMPS_NS
