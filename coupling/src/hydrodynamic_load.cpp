#include "suffuse/coupling/hydrodynamic_load.h"

namespace suffuse::coupling {

double share_within(double radius, double depth) {
  if (depth >= radius) return 1;
  if (depth <= -radius) return 0;
  const double cap = radius - depth;  // beyond the plane
  return 1 - cap * cap * (3 * radius - cap) / (4 * radius * radius * radius);
}

Load surface_load(const Load& exchange, const InternalFluidMomentum& internal, const GrainState& now,
                  const GrainHistory& before, const LoadRule& rule) {
  if (!before.known) return exchange;
  Load load = exchange;
  const double mass = now.immersed * rule.fluid_density * sphere_volume(now.radius);
  load.force += (mass * (now.velocity - before.velocity) + internal.momentum - before.internal.momentum) /
                rule.time_passed;
  if (now.radius < rule.spacing) return load;
  const double moment =
      mass * (micromechanics::sphere_inertia(1, now.radius) + rule.spacing * rule.spacing / 6);
  load.torque +=
      (moment * (now.angular_velocity - before.angular_velocity) + internal.spin - before.internal.spin) /
      rule.time_passed;
  return load;
}

Load hydrodynamic_load(const Load& surface, const GrainState& now, const GrainHistory& before,
                       const LoadRule& rule) {
  Load load = surface;
  if (rule.average && before.known) {
    load.force = 0.5 * (surface.force + before.load.force);
    load.torque = 0.5 * (surface.torque + before.load.torque);
  }
  load.force -= now.immersed * rule.fluid_density * sphere_volume(now.radius) * rule.buoyant_gravity;
  if (!rule.rotation) load.torque.setZero();
  return load;
}

}  // namespace suffuse::coupling
