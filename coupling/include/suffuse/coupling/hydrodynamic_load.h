#pragma once

#include "suffuse/common/linear_algebra.h"

namespace suffuse::coupling {

struct Load {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 torque = Vec3::Zero();  ///< N m, about the grain's centre
};

/// A grain at one fluid step, SI.
struct GrainState {
  double radius = 0;
  Vec3 velocity = Vec3::Zero();  ///< the one that its cells were given in this fluid step
  Vec3 angular_velocity = Vec3::Zero();
};

/// The same grain at the fluid step before.
struct GrainHistory {
  bool known = false;
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Load exchange;
};

struct LoadRule {
  double fluid_density = 1000;          ///< kg/m^3
  double time_step = 0;                 ///< of the fluid, s
  Vec3 buoyant_gravity = Vec3::Zero();  ///< m/s^2; zero without buoyancy
  bool average = false;                 ///< mean exchange of this and the last fluid step
  bool rotation = true;                 ///< false: no torque
};

/// Volume of a sphere, m^3.
double sphere_volume(double radius);

/// What the fluid does to a grain, from what its cells exchanged in a fluid step:
///
///   F = F_exchange + rho_f V (u - u_before)/dt - rho_f V g,   T = T_exchange + 2/5 rho_f V a^2 (w -
///   w_before)/dt.
///
/// The exchange also accelerated the fluid that the grain's cells hold; the second term gives that back, with
/// the very change of velocity that the cells went through. The third is the weight of the displaced fluid:
/// pressures are those in excess of the hydrostatic one (docs/decisions/gravity.md). Without history the
/// second term is zero.
Load hydrodynamic_load(const Load& exchange, const GrainState& now, const GrainHistory& before,
                       const LoadRule& rule);

}  // namespace suffuse::coupling
