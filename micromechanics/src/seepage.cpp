#include "suffuse/micromechanics/seepage.h"

#include <algorithm>
#include <cmath>

namespace suffuse::micromechanics {

double critical_gradient(double porosity, double grain_density, const SeepageFluid& fluid) {
  return (grain_density / fluid.density - 1) * (1 - porosity);
}

double critical_gradient_of_fines(double porosity, double grain_density, double stress_reduction,
                                  const SeepageFluid& fluid) {
  return std::min(1.0, stress_reduction) * critical_gradient(porosity, grain_density, fluid);
}

double critical_gradient_by_top_stress(double porosity, double grain_density, double stress_reduction,
                                       const LayerStress& layer, const SeepageFluid& fluid) {
  const double normalised = layer.stress / (fluid.density * fluid.gravity * layer.thickness);
  return std::min(1.0, stress_reduction) * (normalised + critical_gradient(porosity, grain_density, fluid));
}

double conductivity_hazen(double d10, double coefficient) {
  return coefficient * d10 * d10;
}

double conductivity_carman_kozeny(double diameter, double porosity, const SeepageFluid& fluid) {
  const double solid = 1 - porosity;
  return fluid.gravity / fluid.kinematic_viscosity * diameter * diameter * std::pow(porosity, 3) /
         (180 * solid * solid);
}

double conductivity_chapuis(double d10, double porosity) {
  const double void_ratio = porosity / (1 - porosity), millimetres = 1e3 * d10;
  return 1e-2 * 2.4622 *
         std::pow(millimetres * millimetres * std::pow(void_ratio, 3) / (1 + void_ratio), 0.7825);
}

namespace {

/// Of linear U + square U² = g i.
struct ErgunTerms {
  double linear, square;
};

ErgunTerms ergun_terms(double diameter, double porosity, const SeepageFluid& fluid) {
  const double solid = 1 - porosity, pore = std::pow(porosity, 3);
  return {150 * fluid.kinematic_viscosity * solid * solid / (diameter * diameter * pore),
          1.75 * solid / (diameter * pore)};
}

}  // namespace

double velocity_ergun(double gradient, double diameter, double porosity, const SeepageFluid& fluid) {
  const auto [linear, square] = ergun_terms(diameter, porosity, fluid);
  const double drive = fluid.gravity * std::abs(gradient);
  // The root in the form that loses no digits at small gradients.
  const double velocity = 2 * drive / (linear + std::sqrt(linear * linear + 4 * square * drive));
  return std::copysign(velocity, gradient);
}

double gradient_ergun(double velocity, double diameter, double porosity, const SeepageFluid& fluid) {
  const auto [linear, square] = ergun_terms(diameter, porosity, fluid);
  return velocity * (linear + square * std::abs(velocity)) / fluid.gravity;
}

double minimum_fluidisation_wen_yu(double diameter, double grain_density, const SeepageFluid& fluid) {
  const double nu = fluid.kinematic_viscosity;
  const double archimedes =
      std::pow(diameter, 3) * (grain_density / fluid.density - 1) * fluid.gravity / (nu * nu);
  // sqrt(a² + x) - a in the form that keeps its digits for small grains.
  const double square = 0.0408 * archimedes;
  return nu / diameter * square / (std::sqrt(33.7 * 33.7 + square) + 33.7);
}

}  // namespace suffuse::micromechanics
