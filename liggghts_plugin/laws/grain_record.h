#pragma once

#include <type_traits>

namespace suffuse {

/// What a grain in water keeps from one fluid step to the next: what the last step saw and gave. It goes with
/// the grain between ranks and into restart files (fix hydrodynamic/force). SI, vectors
/// are x y z. All zero for a grain that no fluid step has seen.
struct GrainRecord {
  double velocity[3], angular_velocity[3];     ///< of the last step, m/s, rad/s
  double surface_force[3], surface_torque[3];  ///< N, N m
  double known;                                ///< 1 once there was such a step
  /// Over the fluid steps before (their running mean), m/s^2 and rad/s^2; and the virtual inertia that is to
  /// move with it on both sides of the equations of motion, kg and kg m^2 (virtual_mass.h). Whoever
  /// integrates applies these.
  double acceleration[3], angular_acceleration[3];
  double virtual_mass, virtual_moment;
  /// Of the fluid that it holds, less that of a solid of its density: kg m/s, kg m^2/s.
  double internal_fluid_momentum[3], internal_fluid_spin[3];
  double surveyed;        ///< 1 once the pores around the grain were surveyed for automatic coefficients
  double surveyed_at[3];  ///< where it was then, m
};

/// Raised by whoever changes the record: restart files with another one are refused.
inline constexpr int kGrainRecordVersion = 1;
/// The record as restart files and messages between ranks have it: so many doubles in the order above.
inline constexpr int kGrainRecordValues = sizeof(GrainRecord) / sizeof(double);
static_assert(std::is_standard_layout_v<GrainRecord> && std::is_trivially_copyable_v<GrainRecord> &&
              sizeof(GrainRecord) == kGrainRecordValues * sizeof(double));

}  // namespace suffuse
