#pragma once

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/lattice.h"

namespace suffuse::lbm {

/// Velocity of a direction, cells per step.
inline Vec3 velocity_of(int direction) {
  const int* c = kVelocity[direction];
  return Vec3(c[0], c[1], c[2]);
}

}  // namespace suffuse::lbm
