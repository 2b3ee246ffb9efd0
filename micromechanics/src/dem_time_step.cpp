#include "suffuse/micromechanics/dem_time_step.h"

#include <cmath>
#include <numbers>

namespace suffuse::micromechanics {

double effective_modulus(const GrainMaterial& m) {
  return m.youngs_modulus / (2 * (1 - m.poisson_ratio * m.poisson_ratio));
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
  const double mass = m.density * std::numbers::pi / 6 * m.diameter * m.diameter * m.diameter;
  return std::sqrt(mass / contact_stiffness(m, mean_stress));
}

}  // namespace suffuse::micromechanics
