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

/// Motion of the fluid that a grain's cells hold, as if each of the two parts moved like a solid: the inner
/// cells, covered whole, and those that the surface cuts.
struct HeldFluid {
  Vec3 inner_velocity = Vec3::Zero(), inner_spin = Vec3::Zero();
  Vec3 outer_velocity = Vec3::Zero(), outer_spin = Vec3::Zero();
};

/// The same grain at the fluid step before.
struct GrainHistory {
  bool known = false;
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Load exchange;
  HeldFluid held;
};

/// Cells that lie deeper than this below a sphere's surface (in cells) are covered whole, or nearly.
inline constexpr double kInnerDepth = 0.5;

struct LoadRule {
  double fluid_density = 1000;          ///< kg/m^3
  double time_step = 0;                 ///< of the fluid, s
  Vec3 buoyant_gravity = Vec3::Zero();  ///< m/s^2; zero without buoyancy
  double inner_rate = 1;                ///< lbm::following_rate of whole cells
  double outer_rate = 1;                ///< and of half covered ones
  double inner_depth = 0;               ///< of whole cells below the surface, m
  bool average = false;                 ///< mean exchange of this and the last fluid step
  bool rotation = true;                 ///< false: no torque
};

/// Volume of a sphere, m^3.
double sphere_volume(double radius);

/// Part of a sphere's volume, and of its moment of inertia, that lies deeper than `depth` (m).
struct InnerShares {
  double volume = 0, moment = 0;
};
InnerShares inner_shares(double radius, double depth);

/// Mean motion of all of the fluid that a grain holds, weighted by mass and by moment of inertia.
struct MeanMotion {
  Vec3 velocity, spin;
};
MeanMotion mean_motion(const HeldFluid& held, const InnerShares& inner);

/// After the step that gave the cells the grain's motion `now`; the grain's own without history.
HeldFluid held_fluid(const GrainState& now, const GrainHistory& before, const LoadRule& rule);

/// What the fluid does to a grain, from what its cells exchanged in a fluid step:
///
///   F = F_exchange + rho_f V (U - U_before)/dt - rho_f V g,   T = T_exchange + 2/5 rho_f V a^2 (W -
///   W_before)/dt.
///
/// The exchange also accelerated the fluid that the grain's cells hold; the second term gives that back. U
/// and W are that fluid's mean motion (held_fluid): in steady motion the grain's own; while the grain
/// accelerates, its cells come after it or overshoot, and so does the exchange: the two cancel. The third is
/// the weight of the displaced fluid: pressures are those in excess of the hydrostatic one
/// (docs/decisions/gravity.md). Without history the second term is zero.
Load hydrodynamic_load(const Load& exchange, const GrainState& now, const GrainHistory& before,
                       const LoadRule& rule);

}  // namespace suffuse::coupling
