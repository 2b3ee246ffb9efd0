#include "suffuse/coupling/collision_price.h"

#include <mpi.h>

#include <algorithm>
#include <limits>

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
  const double start = MPI_Wtime();
  fluid.run(2);  // an even and an odd one
  return MPI_Wtime() - start;
}

}  // namespace

double collision_price(const lbm::FluidSettings& settings, const lbm::CollisionSettings& with,
                       const lbm::CollisionSettings& without, const lbm::Index3& cells) {
  lbm::Fluid dear = trial_fluid(settings, with, cells), cheap = trial_fluid(settings, without, cells);
  constexpr int rounds = 5;
  double time_with = std::numeric_limits<double>::max(), time_without = time_with;
  for (int n = 0; n < rounds; ++n) {  // in turn, so that both meet the same load of the machine
    time_with = std::min(time_with, seconds_of_two_steps(dear));
    time_without = std::min(time_without, seconds_of_two_steps(cheap));
  }
  return std::clamp(1 - time_without / time_with, 0., 1.);
}

}  // namespace suffuse::coupling
