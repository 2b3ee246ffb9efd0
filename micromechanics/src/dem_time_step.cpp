#include "suffuse/micromechanics/dem_time_step.h"

#include <cmath>
#include <numbers>

#include "suffuse/micromechanics/sphere.h"

namespace suffuse::micromechanics {

double effective_modulus(const GrainMaterial& m) {
  return m.youngs_modulus / (2 * (1 - m.poisson_ratio * m.poisson_ratio));
}

double grain_mass(const GrainMaterial& g) {
  return g.density * sphere_volume(g.diameter / 2);
}

double stiffness_number(const GrainMaterial& m, double mean_stress) {
  return std::pow(effective_modulus(m) / mean_stress, 2.0 / 3.0);
}

double rayleigh_time(const GrainMaterial& m) {
  const double shear_modulus = m.youngs_modulus / (2 * (1 + m.poisson_ratio));
  return std::numbers::pi * 0.5 * m.diameter * std::sqrt(m.density / shear_modulus) /
         (0.1631 * m.poisson_ratio + 0.8766);
}

double contact_stiffness(const GrainMaterial& m, double mean_stress) {
  const double effective_radius = 0.25 * m.diameter;
  const double overlap = m.diameter / stiffness_number(m, mean_stress);
  return 2 * effective_modulus(m) * std::sqrt(effective_radius * overlap);
}

double oscillation_time(const GrainMaterial& m, double mean_stress) {
  return std::sqrt(grain_mass(m) / contact_stiffness(m, mean_stress));
}

double hooke_stiffness(const HookeContact& c) {
  const double hertz = std::sqrt(c.effective_radius) * c.effective_modulus;
  const double energy = c.effective_mass * c.characteristic_velocity * c.characteristic_velocity;
  return 16. / 15 * hertz * std::pow(15. / 16 * energy / hertz, 0.2);
}

double contact_duration(double effective_mass, double stiffness) {
  return std::numbers::pi * std::sqrt(effective_mass / stiffness);
}

double linear_stiffness_number(double stiffness, double diameter, double mean_stress) {
  return stiffness / (mean_stress * diameter);
}

double density_factor(double time, double reference, double exponent) {
  return time < reference ? std::pow(reference / time, 1 / exponent) : 1;
}

}  // namespace suffuse::micromechanics
