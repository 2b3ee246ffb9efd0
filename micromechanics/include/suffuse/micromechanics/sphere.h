#pragma once

#include <numbers>

namespace suffuse::micromechanics {

/// 4/3 pi r^3.
inline double sphere_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// 2/5 m r^2, of a solid sphere about its centre; of unit mass, the square of its radius of gyration.
inline double sphere_inertia(double mass, double radius) {
  return 0.4 * mass * radius * radius;
}

}  // namespace suffuse::micromechanics
