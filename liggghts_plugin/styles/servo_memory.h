#pragma once

// What `fix stress/servo` knows between two control steps, and how restart files keep it.

#include <vector>

#include "laws/stress_servo.h"
#include "servo_network.h"

namespace suffuse {

/// The grains of a sample, summed over all ranks.
struct ServoGrains {
  double count = 0;
  double density = 0;       ///< mean, kg/m^3
  double solid_volume = 0;  ///< m^3
  double diameter = 0;      ///< the mean that the inertial number takes, m
};

/// Are these sums of the same grains, added up in another order?
bool differ_by_rounding(const ServoGrains& a, const ServoGrains& b);

struct ServoMemory {
  servo::State state;
  Vec3 stress = Vec3::Zero();  ///< normal stresses at the last control step, Pa
  Vec3 shear = Vec3::Zero();   ///< xy, xz, yz
  servo::StaticWindow window;
  ServoNetwork network;  ///< at the last sample
  bool is_static = false;
  ServoGrains grains;
};

/// Of the values below: a restart file with another one is refused.
inline constexpr int kServoMemoryVersion = 3;
std::vector<double> packed(const ServoMemory& memory);
/// The inverse; as many values as `packed` gives.
ServoMemory unpacked(const std::vector<double>& values);

}  // namespace suffuse
