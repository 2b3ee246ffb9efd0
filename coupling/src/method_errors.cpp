#include "suffuse/coupling/method_errors.h"

#include <algorithm>
#include <cmath>

#include "measured_errors.h"

namespace suffuse::coupling {

namespace {

constexpr MeasuredError kForces[] = {{2, 0.14, 0.216},  {3, 0.061, 0.106},   {4, 0.035, 0.05},
                                     {5, 0.026, 0.036}, {8, 0.0107, 0.0175}, {10, 0.0086, 0.0116}};

/// Of a pore's resistance to flow, without its viscosity and grains' size.
double resistance(double solid_fraction) {
  return solid_fraction * drag_factor(DragLaw::beetstra, solid_fraction, 0) / (1 - solid_fraction);
}

/// What a cell, so many cells beyond the surface of a half space of grains, gets of a whole share: the
/// integral of the quadratic spline of axis_shares.h.
double share_beyond_surface(double cells) {
  const double x = std::abs(cells);
  const double inner = 0.5 - 0.75 * x + x * x * x / 3, outer = std::pow(std::max(0., 1.5 - x), 3) / 6;
  const double share = x < 0.5 ? inner : outer;
  return cells > 0 ? share : 1 - share;
}

}  // namespace

double expected_force_error(double cells_per_sauter_diameter) {
  return error_at(kForces, cells_per_sauter_diameter, &MeasuredError::rms);
}

AveragedErrors averaged_errors(DragLaw law) {
  constexpr double gradient = 0.024, forces = 0.34;
  switch (law) {
    case DragLaw::gidaspow:
      return {0.2, gradient, forces};
    case DragLaw::di_felice:
      return {0.47, gradient, forces};
    default:
      return {0.1, gradient, forces};
  }
}

double surface_loss(double solid_fraction) {
  constexpr int parts = 60;
  constexpr double reach = 1.5;
  const double whole = resistance(solid_fraction);
  double loss = 0;
  for (int n = 0; n < parts; ++n) {
    const double height = reach * (2 * (n + 0.5) / parts - 1);
    const double there = resistance(solid_fraction * share_beyond_surface(height)) / whole;
    loss += ((height < 0 ? 1 : 0) - there) * 2 * reach / parts;
  }
  return loss;
}

}  // namespace suffuse::coupling
