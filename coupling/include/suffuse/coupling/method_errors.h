#pragma once

#include "suffuse/coupling/methods/drag_laws.h"

namespace suffuse::coupling {

/// What an accuracy is asked of.
enum class AccuracyOf {
  permeability,       ///< and speeds and gradients that follow from it
  critical_gradient,  ///< at which water lifts a bed: all that counts is the weight that the water carries
  forces,             ///< on single grains
};

/// Error of the force on single grains with the resolved flow at so many cells a Sauter diameter: root mean
/// square over grains of packings of 64 (docs/results/data/price_of_packings.csv; solid fractions 0.4 to
/// 0.62), against 14 cells. Forces are taken as shares of the whole: that of the permeability comes besides.
double expected_force_error(double cells_per_sauter_diameter);

/// Errors of the averaged flow in beds, root mean squares; shares.
struct AveragedErrors {
  /// Of the closure, against resolved drags of nine packings of solid fractions 0.4 to 0.62
  /// (price_of_packings.csv). The largest: one and a half times as much.
  double permeability;
  /// Of two columns of Appendix C's grading, 1.2 and 3.2 % (docs/results/price_of_methods.md,
  /// docs/results/fluidisation_column.md).
  double critical_gradient;
  /// On single grains, of the same packings as the permeability: a closure knows size and porosity only.
  double forces;
};
AveragedErrors averaged_errors(DragLaw law);

/// Length by which water flows along a bed as if it were that much shorter, in cells, because the averaged
/// flow smears a free surface of it over the reach of its kernel: the integral of 1 - R(phi S)/R(phi) with S
/// the kernel's share of a half space and R = phi F/(1 - phi) the resistance of Beetstra's closure in
/// creeping flow. 0.45 at phi = 0.4, 0.6 at 0.6.
double surface_loss(double solid_fraction);

}  // namespace suffuse::coupling
