#include "suffuse/micromechanics/inertial_number.h"

#include <cmath>

namespace suffuse::micromechanics {

double inertial_number(const InertialState& state) {
  if (state.pressure <= 0) return 0;
  return std::abs(state.strain_rate) * state.diameter * std::sqrt(state.density / state.pressure);
}

}  // namespace suffuse::micromechanics
