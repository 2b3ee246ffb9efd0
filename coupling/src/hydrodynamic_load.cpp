#include "suffuse/coupling/hydrodynamic_load.h"

#include <numbers>

namespace suffuse::coupling {

double sphere_volume(double radius) {
  return 4. / 3 * std::numbers::pi * radius * radius * radius;
}

InnerShares inner_shares(double radius, double depth) {
  const double share = depth < radius ? 1 - depth / radius : 0, cube = share * share * share;
  return {cube, cube * share * share};
}

MeanMotion mean_motion(const HeldFluid& held, const InnerShares& inner) {
  return {held.outer_velocity + inner.volume * (held.inner_velocity - held.outer_velocity),
          held.outer_spin + inner.moment * (held.inner_spin - held.outer_spin)};
}

HeldFluid held_fluid(const GrainState& now, const GrainHistory& before, const LoadRule& rule) {
  if (!before.known) return {now.velocity, now.angular_velocity, now.velocity, now.angular_velocity};
  const auto follow = [](const Vec3& fluid, const Vec3& grain, double rate) {
    return Vec3(fluid + rate * (grain - fluid));
  };
  return {follow(before.held.inner_velocity, now.velocity, rule.inner_rate),
          follow(before.held.inner_spin, now.angular_velocity, rule.inner_rate),
          follow(before.held.outer_velocity, now.velocity, rule.outer_rate),
          follow(before.held.outer_spin, now.angular_velocity, rule.outer_rate)};
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
    const InnerShares inner = inner_shares(now.radius, rule.inner_depth);
    const MeanMotion then = mean_motion(before.held, inner),
                     after = mean_motion(held_fluid(now, before, rule), inner);
    load.force += displaced_mass / rule.time_step * (after.velocity - then.velocity);
    load.torque += 0.4 * displaced_mass * now.radius * now.radius / rule.time_step * (after.spin - then.spin);
  }
  load.force -= displaced_mass * rule.buoyant_gravity;
  if (!rule.rotation) load.torque.setZero();
  return load;
}

}  // namespace suffuse::coupling
