#include "suffuse/micromechanics/quasi_static.h"

#include <cmath>
#include <numbers>

#include "suffuse/micromechanics/coordination.h"

namespace suffuse::micromechanics {

double inertial_number(const InertialState& state) {
  if (state.pressure <= 0) return 0;
  return std::abs(state.strain_rate) * state.diameter * std::sqrt(state.density / state.pressure);
}

double equivalent_youngs_modulus(const GrainMaterial& material) {
  return material.youngs_modulus / (2 * (1 - material.poissons_ratio * material.poissons_ratio));
}

double rayleigh_time(const GrainMaterial& material, double radius) {
  const double shear_modulus = material.youngs_modulus / (2 * (1 + material.poissons_ratio));
  return std::numbers::pi * radius * std::sqrt(material.density / shear_modulus) /
         (0.1631 * material.poissons_ratio + 0.8766);
}

double mean_contact_force(double diameter, const PackingState& state) {
  return std::numbers::pi * diameter * diameter * state.mean_stress / (state.coordination * state.solid_fraction);
}

double hertz_overlap(const GrainMaterial& material, double radius, double normal_force) {
  const double force_scale = 4.0 / 3.0 * equivalent_youngs_modulus(material) * std::sqrt(radius / 2);
  return std::pow(normal_force / force_scale, 2.0 / 3.0);
}

double hertz_tangent_stiffness(const GrainMaterial& material, double radius, double normal_force) {
  const double overlap_length = hertz_overlap(material, radius, normal_force);
  return 2 * equivalent_youngs_modulus(material) * std::sqrt(radius / 2 * overlap_length);
}

TimeStepLimits time_step_limits(const GrainMaterial& material, double radius, const PackingState& state) {
  const double mass = material.density * sphere_volume(radius);
  const double force = mean_contact_force(2 * radius, state);
  const double period_scale = std::sqrt(mass / hertz_tangent_stiffness(material, radius, force));
  return {2 * period_scale, 0.22 * period_scale, rayleigh_time(material, radius)};
}

double stiffness_number(const GrainMaterial& material, double mean_stress) {
  return std::pow(equivalent_youngs_modulus(material) / mean_stress, 2.0 / 3.0);
}

}  // namespace suffuse::micromechanics
