#include "suffuse/coupling/virtual_mass.h"

#include <cmath>
#include <numbers>

#include "suffuse/coupling/hydrodynamic_load.h"

namespace suffuse::coupling {

namespace {
/// Share of the mass from which on the response is taken over to the grain's side.
constexpr double kSafeShare = 0.4;
/// Virtual mass over the estimated response.
constexpr double kMargin = 1.5;
}  // namespace

double response_coefficient(double radius, double viscosity) {
  const double larger = 1 + 0.5 / radius;
  return 0.5 * larger * larger * larger + 9 * std::sqrt(viscosity / std::numbers::pi) / radius +
         4.5 * viscosity / (radius * radius);
}

double rotational_response_coefficient(double radius, double viscosity) {
  return 10 * std::sqrt(viscosity / std::numbers::pi) / radius + 15 * viscosity / (radius * radius);
}

VirtualInertia virtual_inertia(const VirtualMassRule& rule, double radius, double mass) {
  const double displaced = rule.fluid_density * sphere_volume(radius), arm = 0.4 * radius * radius;
  if (rule.coefficient) return {*rule.coefficient * displaced, *rule.coefficient * displaced * arm};
  const double a = radius / rule.spacing;
  const double response = response_coefficient(a, rule.viscosity) * displaced,
               turning = rotational_response_coefficient(a, rule.viscosity) * displaced;
  return {response > kSafeShare * mass ? kMargin * response : 0.,
          turning > kSafeShare * mass ? kMargin * turning * arm : 0.};
}

}  // namespace suffuse::coupling
