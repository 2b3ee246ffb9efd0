#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::micromechanics {

/// A grain where it was placed; in the box from 0 to its sides, m.
struct PlacedGrain {
  Vec3 centre = Vec3::Zero();
  double diameter = 0;
};

/// Spheres of these diameters (m) at random in a periodic box of these sides (m), none in touch, by random
/// sequential addition from the largest to the smallest (key: torquato2006). The same for the same seed, on
/// any machine. Throws UserError where a grain is wider than the box, or finds no place in 2 million tries.
std::vector<PlacedGrain> place_at_random(std::span<const double> diameters, const Vec3& sides,
                                         std::uint64_t seed);

}  // namespace suffuse::micromechanics
