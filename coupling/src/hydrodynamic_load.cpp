#include "suffuse/coupling/hydrodynamic_load.h"

#include <numbers>

namespace suffuse::coupling {

double sphere_volume(double radius) {
  return 4. / 3 * std::numbers::pi * radius * radius * radius;
}

Load hydrodynamic_load(const Load& exchange, const GrainState& now, const GrainHistory& before,
                       const LoadRule& rule) {
  Load load = exchange;
  const double displaced_mass = rule.fluid_density * sphere_volume(now.radius);
  if (before.known) {
    if (rule.average) {
      load.force = 0.5 * (exchange.force + before.exchange.force);
      load.torque = 0.5 * (exchange.torque + before.exchange.torque);
    }
    load.force += displaced_mass / rule.time_step * (now.velocity - before.velocity);
    load.torque += 0.4 * displaced_mass * now.radius * now.radius / rule.time_step *
                   (now.angular_velocity - before.angular_velocity);
  }
  load.force -= displaced_mass * rule.buoyant_gravity;
  if (!rule.rotation) load.torque.setZero();
  return load;
}

}  // namespace suffuse::coupling
