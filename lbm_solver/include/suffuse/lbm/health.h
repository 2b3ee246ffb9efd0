#pragma once

#include <string>

#include "suffuse/lbm/fluid.h"
#include "suffuse/lbm/units.h"

namespace suffuse::lbm {

/// The largest Mach number.
double mach_of(const FluidExtremes& extremes);

/// A LostRun that names cause and remedy where a run has blown up or is about to: a density or velocity
/// that is not a number, or a Mach number above the limit. `who` begins the message, e.g. "lbm run".
void require_stable(const FluidExtremes& extremes, const Units& units, double time_si, double largest_mach,
                    const std::string& who);

/// "Mach 0.031  density -0.10 .. +1.25 %", for progress lines.
std::string health_text(const FluidExtremes& extremes);

}  // namespace suffuse::lbm
