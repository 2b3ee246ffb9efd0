#include "compute_constraint_ratio.h"

#include "compute_sliding_contacts.h"
#include "lammps.h"
#include "suffuse/micromechanics/constraint_ratio.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

namespace {

double verdict(double ratio) {
  switch (hydromechanical_state(ratio)) {
    case HydromechanicalState::stable:
      return 1;
    case HydromechanicalState::transitional:
      return 0;
    case HydromechanicalState::fluid_like:
      break;
  }
  return -1;
}

}  // namespace

ComputeConstraintRatio::ComputeConstraintRatio(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  rule_ = read_sliding_words(reader);
  need_friction();
  declare_vector(6);
}

void ComputeConstraintRatio::compute_vector() {
  invoked_vector = update->ntimestep;
  const Packing& sample = packing();
  const Coordination z = coordination(over_ranks(coordination_sums(sample, {})), sample.volume);
  const Sliding slip = sliding(over_ranks(sliding_sums(sample, rule_)));
  const ConstraintRatio ratio = constraint_ratio(z, slip.share);
  values_ = {ratio.mean, ratio.geometric, ratio.mechanical, verdict(ratio.mean), slip.share, z.mean};
  vector = values_.data();
}
