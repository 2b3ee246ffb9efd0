#ifdef FIX_CLASS

// clang-format off
FixStyle(contact/sampler, FixContactSampler)
// clang-format on

#else

#ifndef SUFFUSE_FIX_CONTACT_SAMPLER_H
#define SUFFUSE_FIX_CONTACT_SAMPLER_H

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "compute.h"
#include "contact_collector.h"
#include "fix.h"
#include "suffuse/micromechanics/contact_network.h"
#include "wall_collector.h"

namespace LAMMPS_NS {

class PairGran;

/// Finds all grain–grain contacts and their forces, once for every step on which some compute of ours is
/// evaluated.
///
/// Added by the first style that needs it (`FixContactSampler::of`); scripts never name it. It samples in
/// post_force, where ghost velocities are those of the force computation, so that the forces are exactly the
/// ones that the integrator uses, on any number of ranks. A value that is asked for on another step (a
/// variable evaluated by `print` between runs) is sampled on demand, after ghost positions and velocities
/// have been brought up to date.
///
/// Cost: nothing on steps without a request; otherwise two passes over the neighbour list with the contact
/// law, each about the time of one force computation, and three more where friction is asked for.
class FixContactSampler : public Fix {
 public:
  FixContactSampler(LAMMPS* lmp, int narg, char** arg);
  ~FixContactSampler() override;

  /// The sampler of this LIGGGHTS instance, created when first asked for.
  static FixContactSampler& of(LAMMPS* lmp);

  /// From now on, sample on the steps that `compute` has been asked for in advance (its timeflag must be
  /// set).
  void add_user(Compute* compute);

  /// The same for how much of each contact's friction is mobilised; besides add_user().
  void add_friction_user(Compute* compute);

  /// The same for contacts with walls.
  void add_wall_user(Compute* compute);

  /// To be called by the destructor of a compute that was added.
  static void forget_user(LAMMPS* lmp, Compute* compute);

  /// Sample on this step as well, with the mobilised friction or without; any number of steps may be waiting.
  void request(bigint step, bool friction = false);

  /// Grains of a group that this rank owns and their contacts with grains of the same group, at the current
  /// step. Forces are those on `first`; volume is that of the box. Valid until the next call on another step.
  const suffuse::micromechanics::Packing& packing(int group_bit);

  /// The same with Contact::friction_limit and spring_force.
  const suffuse::micromechanics::Packing& packing_with_friction(int group_bit);

  /// Contacts of those grains with the script's granular walls. Sampled after all fixes have acted on the
  /// grains, so that the walls' springs are those of the step wherever the walls stand in the script.
  std::vector<suffuse::micromechanics::WallContact> walls(int group_bit);

  /// Rises with every sampling, by which what packing() gives changes.
  std::int64_t generation() const { return generation_; }

  /// Index in Packing::grains of owned atom i, or kNotOwned if it is outside the group; same order as
  /// packing().
  const std::vector<int>& grain_index(int group_bit);

  /// Exponent of the normal force in the overlap: 1.5 for Hertz, 1 for a linear spring.
  double force_exponent() const;

  void pre_delete(bool unfixflag) override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  void pre_final_integrate() override;

 private:
  struct GroupPacking {
    suffuse::micromechanics::Packing packing;
    std::vector<int> index;
  };

  bool asked_by(const std::vector<Compute*>& users) const;
  void sample(bool friction);
  void add_contact(const ContactCollector::Found& found);
  suffuse::micromechanics::Image image_in(const suffuse::micromechanics::Contact& found) const;
  GroupPacking& group_packing(int group_bit);

  void sample_walls();

  std::unique_ptr<ContactCollector> collector_;
  std::unique_ptr<WallCollector> wall_collector_;
  PairGran* pair_ = nullptr;
  std::vector<Compute*> users_, friction_users_, wall_users_;
  std::set<bigint> requested_steps_, friction_steps_;
  bigint sampled_step_ = -1;
  bool has_friction_ = false;  // of the sampled step
  bigint walls_step_ = -1;
  std::vector<WallCollector::Found> walls_;
  std::int64_t generation_ = 0;
  double volume_ = 0;
  suffuse::Vec3 box_low_ = suffuse::Vec3::Zero();
  suffuse::Vec3 box_high_ = suffuse::Vec3::Zero();
  std::vector<suffuse::micromechanics::Contact>
      contacts_;                  // indices are those of LIGGGHTS's atoms, ghosts too, all groups
  std::vector<double> friction_;  // coefficient for each pair of types
  std::map<int, GroupPacking> by_group_;
};

}  // namespace LAMMPS_NS

#endif
#endif
