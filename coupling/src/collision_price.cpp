#include "suffuse/coupling/collision_price.h"

#include <mpi.h>

#include <algorithm>
#include <limits>

#include "suffuse/common/processor_time.h"

namespace suffuse::coupling {

namespace {

/// A periodic box of a rank's own, with the collision and the kinds of kernel that a coupled fluid has.
lbm::Fluid trial_fluid(lbm::FluidSettings settings, const lbm::CollisionSettings& collision,
                       const lbm::Index3& cells) {
  settings.collision = collision;
  settings.faces = {};
  lbm::Fluid fluid(settings, lbm::Decomposition::balanced(MPI_COMM_SELF, cells));
  fluid.use_partial_solids({});
  return fluid;
}

double seconds_of_two_steps(lbm::Fluid& fluid) {
  const double start = processor_seconds();
  fluid.run(2);  // an even and an odd one
  return processor_seconds() - start;
}

}  // namespace

double collision_price(const lbm::FluidSettings& settings, const lbm::CollisionSettings& with,
                       const lbm::CollisionSettings& without, const lbm::Index3& cells) {
  lbm::Fluid dear = trial_fluid(settings, with, cells), cheap = trial_fluid(settings, without, cells);
  constexpr int least = 5, most = 100;
  constexpr double enough = 0.1;  // s
  double time_with = std::numeric_limits<double>::max(), time_without = time_with;
  const double start = MPI_Wtime();
  for (int n = 0; n < least || (n < most && MPI_Wtime() - start < enough);
       ++n) {  // in turn: the same clock rate
    time_with = std::min(time_with, seconds_of_two_steps(dear));
    time_without = std::min(time_without, seconds_of_two_steps(cheap));
  }
  return std::clamp(1 - time_without / time_with, 0., 1.);
}

}  // namespace suffuse::coupling
