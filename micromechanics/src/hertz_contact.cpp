#include "suffuse/micromechanics/hertz_contact.h"

#include <cmath>

namespace suffuse::micromechanics {

double hertz_force(const HertzPair& pair, double overlap) {
  return 2. / 3 * hertz_stiffness_at(pair, overlap) * overlap;
}

double hertz_stiffness_at(const HertzPair& pair, double overlap) {
  return 2 * pair.effective_modulus * std::sqrt(pair.effective_radius * overlap);
}

}  // namespace suffuse::micromechanics
