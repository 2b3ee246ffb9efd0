#include "suffuse/lbm/health.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/common/error.h"

namespace suffuse::lbm {

double mach_of(const FluidExtremes& extremes) {
  return extremes.largest_speed * std::sqrt(3.);
}

namespace {

/// Close to 0.5 the viscosity is too small for the spacing; else the time step is too long for the speed.
/// `share` of the time step would do as far as the Mach number goes.
std::string remedy(const Units& units, double share) {
  if (units.relaxation_time() < 0.52)
    return fmt::format(
        "relaxation_time is {:.4g}, close to its lower limit: use a smaller spacing, or an eddy viscosity "
        "(`lbm "
        "effect turbulence on`), or change boundary values more slowly",
        units.relaxation_time());
  return fmt::format(
      "use a timestep below {:.3g} s (relaxation_time below {:.4g}), or change boundary values more slowly",
      share * units.time_step(), 0.5 + share * (units.relaxation_time() - 0.5));
}

}  // namespace

void require_stable(const FluidExtremes& extremes, const Units& units, double time_si, double largest_mach,
                    const std::string& who) {
  const std::string what = fmt::format("flow at {:.5g} s", time_si);
  constexpr double half = 0.5;
  if (!extremes.finite) throw_lost_run({who, what, "not a number", "stay finite", remedy(units, half)});
  const double mach = mach_of(extremes);
  if (mach > largest_mach)
    throw_lost_run(
        {who, what, fmt::format("Mach number {:.5g}", mach),
         fmt::format("stay below {:g}: a lattice fluid is nearly incompressible only there", largest_mach),
         remedy(units, std::min(half, largest_mach / mach))});
}

std::string health_text(const FluidExtremes& extremes) {
  return fmt::format("Mach {:.3f}  density {:+.2f} .. {:+.2f} %", mach_of(extremes),
                     100 * (extremes.smallest_density - 1), 100 * (extremes.largest_density - 1));
}

}  // namespace suffuse::lbm
