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
/// k of the viscosity-independent weighting where it is found cell by cell, for spheres of about a cell.
constexpr double kUsualCoefficient = kSafeCoefficient;
/// In the pores of a bed the answer to a grain's turning is some times that of a lone sphere: there its
/// cells' coefficient is largest.
constexpr double kAmongNeighbours = 4;
/// A sphere below two cells lies in so many of them in the mean, and covers no more of each.
constexpr double kCellsOfAPoint = 4, kLargestFraction = 0.35;

/// What the fluid in and around a grain answers with, in kg, to a change of its velocity and of its spin.
struct Response {
  double moving = 0, turning = 0;
};

Response response_of(const VirtualMassRule& rule, double radius, double mass) {
  const double displaced = rule.fluid_density * sphere_volume(radius);
  const double a = radius / rule.spacing, viscosity = lbm::viscosity_of(rule.relaxation_time);
  // A light grain is slower to follow than its cells, whose answers of several steps add up.
  const double of_cells =
      cell_response_coefficient(a, rule.cells, rule.relaxation_time) * std::max(1., displaced / mass);
  return {std::min(response_coefficient(a, viscosity), of_cells) * displaced,
          std::min(kAmongNeighbours * rotational_response_coefficient(a, viscosity), of_cells) * displaced};
}

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

double virtual_mass_number(const VirtualMassRule& rule, double radius, double mass) {
  const Response response = response_of(rule, radius, mass);
  return std::max(response.moving, response.turning) / mass;
}

double virtual_drag(double added, double own, int substeps, double fluid_step) {
  const double ratio = added / own;
  if (ratio <= 0) return 0;
  if (substeps == 1) return 2 * added / fluid_step;
  double x = ratio * (2 + ratio) / (1 + ratio);
  for (int k = 0; k < 2; ++k) {  // Newton's on 1 - exp(-x) = x/(1 + ratio)
    const double decay = std::exp(-x), wanted = 1 / (1 + ratio);
    x -= (1 - decay - wanted * x) / (decay - wanted);
  }
  return x * own / fluid_step;
}

VirtualInertia virtual_inertia(const VirtualMassRule& rule, double radius, double mass) {
  const double arm = micromechanics::sphere_inertia(1, radius);
  if (rule.coefficient) {
    const double added = *rule.coefficient * rule.fluid_density * sphere_volume(radius);
    return {added, added * arm};
  }
  const Response response = response_of(rule, radius, mass);
  return {std::max(0., response.moving - kSafeResponse * mass),
          std::max(0., response.turning - kSafeResponse * mass) * arm};
}

}  // namespace suffuse::coupling
