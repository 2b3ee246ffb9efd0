#include "suffuse/micromechanics/constraint_ratio.h"

#include <cmath>

namespace suffuse::micromechanics {

ConstraintRatio constraint_ratio(const Coordination& coordination, double sliding_share) {
  const double constraints = (3 - 2 * sliding_share) / 12;
  return {coordination.mean * constraints, coordination.geometric * constraints,
          coordination.mechanical * constraints};
}

HydromechanicalState hydromechanical_state(double constraint_ratio, double tolerance) {
  if (std::abs(constraint_ratio - 1) <= tolerance) return HydromechanicalState::transitional;
  return constraint_ratio > 1 ? HydromechanicalState::stable : HydromechanicalState::fluid_like;
}

const char* to_string(HydromechanicalState state) {
  switch (state) {
    case HydromechanicalState::stable:
      return "stable";
    case HydromechanicalState::transitional:
      return "transitional";
    case HydromechanicalState::fluid_like:
      break;
  }
  return "fluid-like";
}

}  // namespace suffuse::micromechanics
