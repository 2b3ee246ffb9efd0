#pragma once

#include <vector>

#include "suffuse/micromechanics/coordination.h"

namespace suffuse::micromechanics {

/// For each grain whether it takes part in the force network: grains with fewer than `minimum` contacts are
/// taken away with their contacts, again and again, until none is left (`thornton2000` takes away those with
/// 0 and 1 once). `minimum`: 2 with friction, 4 without. A whole packing, all of whose contacts have both
/// grains in it; a contact with an image counts for its first grain and is never taken away from it.
std::vector<bool> load_bearing(const Packing& packing, int minimum);

/// Grains outside the force network.
struct Rattlers {
  double share = 0;        ///< by number, of all grains; 0 to 1
  double fines_share = 0;  ///< by number, of the fines; 0 without fines
  double solid_share = 0;  ///< by volume, of all solids
};

/// `bearing`: of load_bearing(), in the order of Packing::grains.
Rattlers rattlers(const Packing& packing, const std::vector<bool>& bearing, SizeSplit split);

}  // namespace suffuse::micromechanics
