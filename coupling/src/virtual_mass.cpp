#include "suffuse/coupling/virtual_mass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "suffuse/coupling/automatic_coefficient.h"
#include "suffuse/coupling/hydrodynamic_load.h"
#include "suffuse/lbm/collision_settings.h"

namespace suffuse::coupling {

namespace {
/// Share of the mass from which on the response is taken over to the grain's side.
constexpr double kSafeShare = 0.4;
/// Virtual mass over the estimated response.
constexpr double kMargin = 1.5;
/// k of the viscosity-independent weighting where it is found cell by cell, for spheres of about a cell.
constexpr double kUsualCoefficient = kLargestCoefficient;
/// A sphere below two cells lies in so many of them in the mean, and covers no more of each.
constexpr double kCellsOfAPoint = 4, kLargestFraction = 0.35;
}  // namespace

double response_coefficient(double radius, double viscosity) {
  const double larger = 1 + 0.5 / radius;
  return 0.5 * larger * larger * larger + 9 * std::sqrt(viscosity / std::numbers::pi) / radius +
         4.5 * viscosity / (radius * radius);
}

double cell_response_coefficient(double radius, const lbm::PartialSolidSettings& cells,
                                 double relaxation_time) {
  if (radius >= 1) return std::numeric_limits<double>::infinity();
  const double fraction = std::min(sphere_volume(radius) / kCellsOfAPoint, kLargestFraction);
  const lbm::PartialSolidCell cell{fraction, (cells.own_coefficients ? kUsualCoefficient : 1) * fraction};
  return 2 * lbm::mean_share(cells, cell, relaxation_time) / fraction / (1 - radius * radius);
}

double rotational_response_coefficient(double radius, double viscosity) {
  return 10 * std::sqrt(viscosity / std::numbers::pi) / radius + 15 * viscosity / (radius * radius);
}

VirtualInertia virtual_inertia(const VirtualMassRule& rule, double radius, double mass) {
  const double displaced = rule.fluid_density * sphere_volume(radius),
               arm = micromechanics::sphere_inertia(1, radius);
  if (rule.coefficient) return {*rule.coefficient * displaced, *rule.coefficient * displaced * arm};
  const double a = radius / rule.spacing, viscosity = lbm::viscosity_of(rule.relaxation_time);
  // A light grain is slower to follow than its cells, whose answers of several steps add up.
  const double of_cells =
      cell_response_coefficient(a, rule.cells, rule.relaxation_time) * std::max(1., displaced / mass);
  const double response = std::min(response_coefficient(a, viscosity), of_cells) * displaced;
  const double turning = std::min(rotational_response_coefficient(a, viscosity), of_cells) * displaced;
  return {response > kSafeShare * mass ? kMargin * response : 0.,
          turning > kSafeShare * mass ? kMargin * turning * arm : 0.};
}

}  // namespace suffuse::coupling
