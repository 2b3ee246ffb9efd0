#pragma once

#include "suffuse/common/linear_algebra.h"
#include "suffuse/micromechanics/sphere.h"

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
  double immersed = 1;  ///< part of its volume that lies in the water's box, where its cells are
};

/// Momentum and angular momentum (kg m/s, kg m^2/s) by which the fluid in a grain's cells is ahead of a solid
/// of its density that moves like the grain, after a fluid step.
struct InternalFluidMomentum {
  Vec3 momentum = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
};

/// The same grain when its last load was found: at the fluid step before, or earlier.
struct GrainHistory {
  bool known = false;
  Vec3 velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Load load;  ///< surface_load
  InternalFluidMomentum internal;
};

struct LoadRule {
  double fluid_density = 1000;          ///< kg/m^3
  double time_passed = 0;               ///< since the loads that GrainHistory holds, s: a fluid step or more
  double spacing = 0;                   ///< of its cells, m
  Vec3 buoyant_gravity = Vec3::Zero();  ///< m/s^2; zero without buoyancy
  bool average = false;                 ///< mean load of this and the last fluid step
  bool rotation = true;                 ///< false: no torque
};

using micromechanics::sphere_volume;

/// Part of a sphere's volume on one side of a plane, on which its centre lies `depth` deep (negative: beyond
/// it).
double share_within(double radius, double depth);

/// What the fluid outside does to a grain, from what its cells exchanged in a fluid step:
///
///   F = F_exchange + d/dt (rho_f V u + P),   T = T_exchange + d/dt (rho_f V (2/5 a^2 + dx^2/6) w + L),
///
/// P and L being `internal`.
///
/// The exchange also accelerates the fluid that the grain's cells hold, whose momentum is the bracket; its
/// change over the time passed gives that back (docs key: kempefrohlich2012). What is left is what has come
/// in through the surface. dx^2/6 is the moment that a sphere gains because each of its points moves with the
/// cell around it. Without history the second term is zero, and for spheres below two cells a diameter that
/// of the torque: a cell or two hold them, whose own inertia is larger than theirs.
Load surface_load(const Load& exchange, const InternalFluidMomentum& internal, const GrainState& now,
                  const GrainHistory& before, const LoadRule& rule);

/// What the grain feels: `surface`, or its mean with the step before, less the weight of the displaced fluid,
/// rho_f V g, since pressures are those in excess of the hydrostatic one (docs/decisions/gravity.md).
Load hydrodynamic_load(const Load& surface, const GrainState& now, const GrainHistory& before,
                       const LoadRule& rule);

}  // namespace suffuse::coupling
