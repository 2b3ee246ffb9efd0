#ifndef SUFFUSE_CONTACT_COMPUTE_H
#define SUFFUSE_CONTACT_COMPUTE_H

#include <string>
#include <vector>

#include "compute.h"
#include "sample_choice.h"
#include "style_support.h"
#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/sums.h"

namespace LAMMPS_NS {

/// What our computes of the contact network share: they register with the contact sampler, so that contacts
/// are found once for all of them and only on steps on which one of them is evaluated, and they own their
/// output.
///
/// Contacts count where both grains are in the compute's group. The volume is that of the box, or of the
/// sample that the script has chosen.
class ContactCompute : public Compute {
 public:
  ~ContactCompute() override;
  void init() override;
  /// The first value of the vector.
  double compute_scalar() override;

 protected:
  ContactCompute(LAMMPS* lmp, int& iarg, int narg, char** arg);

  /// Grains and contacts of the group on this rank at the current step.
  ///
  /// With the words `region`, `bed` and `walls` (read_sample_word) only those of the sample, its volume and
  /// its bounds. Collective.
  const suffuse::micromechanics::Packing& packing();

  /// The same of all grains of the group, whatever the sample: for values of each grain.
  const suffuse::micromechanics::Packing& packing_of_group();

  /// For a constructor: reads `region ID`, `bed` or `walls yes|no` where `key` is one of them.
  bool read_sample_word(const std::string& key, suffuse::ArgumentReader& reader);
  /// For a constructor, before it reads its words: contacts with walls count unless the script says `walls
  /// no`.
  void count_walls_by_default();
  /// For a constructor, after it has read its words.
  void sample_is_read();

  /// To be called by a constructor: packing() tells how much friction the contacts have mobilised.
  void need_friction();

  /// "compute <style>", for messages.
  std::string who() const { return std::string("compute ") + style; }

  /// Sums of all ranks.
  template <class Sums>
  Sums over_ranks(Sums sums) {
    suffuse::sum_over_ranks(lmp, suffuse::micromechanics::as_doubles(sums));
    return sums;
  }

  /// Declares a global vector of this length and, as the scalar, its first value.
  void declare_vector(int length);
  /// Declares a global array.
  void declare_array(int rows, int columns);

  suffuse::SampleChoice sample_;
  std::vector<double> values_;  ///< the global vector

 private:
  bool needs_friction_ = false;
  std::int64_t part_generation_ = -1, group_generation_ = -1;
  suffuse::micromechanics::Packing part_, group_;  // copies, where the sampler's own do not serve
  std::vector<double> cells_;
  std::vector<double*> rows_;
};

/// Words that several computes take: `split DIAMETER`.
suffuse::micromechanics::SizeSplit read_split(suffuse::ArgumentReader& reader);

}  // namespace LAMMPS_NS

#endif
