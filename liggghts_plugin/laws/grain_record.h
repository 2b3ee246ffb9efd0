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
  /// Of the averaged flow: inertia that resists beside the grain's own, kg.
  double added_mass;
  /// Of the resolved flow, its answer as it is foreseen until the next fluid step: a drag towards `velocity`
  /// and `angular_velocity`, kg/s and kg m^2/s. What it takes is withheld, N s and N m s, and returned bit by
  /// bit as a force, N and N m (virtual_mass.h). Whoever integrates applies these and adds to what is
  /// withheld.
  double virtual_drag, virtual_spin_drag;
  double withheld_impulse[3], withheld_spin[3];
  double returned_force[3], returned_torque[3];
  /// Of the fluid that it holds, less that of a solid of its density: kg m/s, kg m^2/s.
  double internal_fluid_momentum[3], internal_fluid_spin[3];
  double surveyed;        ///< 1 once the pores around the grain were surveyed for automatic coefficients
  double surveyed_at[3];  ///< where it was then, m
};

/// Raised by whoever changes the record: restart files with another one are refused.
inline constexpr int kGrainRecordVersion = 2;
/// The record as restart files and messages between ranks have it: so many doubles in the order above.
inline constexpr int kGrainRecordValues = sizeof(GrainRecord) / sizeof(double);
static_assert(std::is_standard_layout_v<GrainRecord> && std::is_trivially_copyable_v<GrainRecord> &&
              sizeof(GrainRecord) == kGrainRecordValues * sizeof(double));

}  // namespace suffuse
