#pragma once

#include "suffuse/lbm/fluid.h"

namespace suffuse::coupling {

/// Which share of a fluid step's time the collision `with` takes that `without` would not, 0 to 1: measured
/// by steps of two fluids of so many cells on this rank alone, with solids that cover nothing, at rest.
/// Fluids of some 1e5 cells tell it to about 0.02; two of them are allocated meanwhile.
double collision_price(const lbm::FluidSettings& settings, const lbm::CollisionSettings& with,
                       const lbm::CollisionSettings& without, const lbm::Index3& cells);

}  // namespace suffuse::coupling
