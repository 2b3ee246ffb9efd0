#include "suffuse/micromechanics/hertz_contact.h"

#include <cmath>
#include <numbers>

namespace suffuse::micromechanics {

double hertz_overlap(const HertzPair& pair, double normal_force) {
  const double force_scale = 4.0 / 3.0 * pair.effective_modulus * std::sqrt(pair.effective_radius);
  return std::pow(normal_force / force_scale, 2.0 / 3.0);
}

double hertz_tangent_stiffness(const HertzPair& pair, double normal_force) {
  return hertz_stiffness_at(pair, hertz_overlap(pair, normal_force));
}

double hertz_force(const HertzPair& pair, double overlap) {
  return 2. / 3 * hertz_stiffness_at(pair, overlap) * overlap;
}

double hertz_stiffness_at(const HertzPair& pair, double overlap) {
  return 2 * pair.effective_modulus * std::sqrt(pair.effective_radius * overlap);
}

double mean_contact_force(double diameter, const PackingState& state) {
  return std::numbers::pi * diameter * diameter * state.mean_stress /
         (state.coordination * state.solid_fraction);
}

}  // namespace suffuse::micromechanics
