#include "suffuse/coupling/collision_price.h"

#include <mpi.h>

#include <algorithm>
#include <ctime>
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

/// Of the processor, which other programs on it take nothing of.
double seconds_of_two_steps(lbm::Fluid& fluid) {
  const std::clock_t start = std::clock();
  fluid.run(2);  // an even and an odd one
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
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
