#pragma once

#include <string>
#include <vector>

#include "suffuse/lbm/fluid.h"

namespace suffuse::coupling {

/// What a scene is like, for settings of a wanted accuracy; SI.
struct AccuracyScene {
  double fine_diameter = 0;   ///< below which a quarter of the grains' surface lies, m; 0 without grains
  double velocity = 0;        ///< of the fastest water expected, m/s
  double grain_speed = 0;     ///< of the fastest grains expected, m/s; 0 where none moves
  double pressure_range = 0;  ///< largest difference of pressures in the water, Pa
  double density = 1000;      ///< kg/m³
  double viscosity = 1e-6;    ///< kinematic, m²/s
  double response_time = 0;   ///< in which the smallest grain follows its water, s; 0 where none moves
  Vec3 size = Vec3::Zero();   ///< of the fluid's box, m
};

/// Errors by source, shares of the permeability or of a speed.
struct AccuracyErrors {
  double resolution = 0;       ///< expected_permeability_error() of the finest quarter of the surface
  double compressibility = 0;  ///< Mach number squared
  double density = 0;          ///< half of the difference of densities that the pressures make
  double motion = 0;           ///< drag of grains that carry their water along
  /// While speeds change: grains feel the water of half a step ago, as a share of the smallest one's
  /// response. No part of `together`, for nothing is left of it once the flow is steady.
  double coupling = 0;
  /// Of independent sources.
  double together() const;
};

/// What a lattice of these cells and steps is expected to err by.
AccuracyErrors expected_errors(const AccuracyScene& scene, double spacing, double time_step,
                               lbm::CollisionOperator collision);
/// sqrt(3) times the cells that the fastest of water and grains passes in a step.
double expected_mach(const AccuracyScene& scene, double spacing, double time_step);

struct AccuracyChoice {
  double cells = 0;  ///< a fine diameter
  double spacing = 0, time_step = 0, relaxation_time = 0;
  double mach = 0;
  lbm::Precision precision = lbm::Precision::float_precision;
  lbm::CollisionOperator collision = lbm::CollisionOperator::trt;
  AccuracyErrors errors;
  const char* bound = "";  ///< what keeps the time step from being larger
  double cost = 0;         ///< cells times steps a second of the run's time: ratios of it are ratios of time
};

/// The cheapest settings of the default operators whose expected error (a root mean square) is at most two
/// thirds of `accuracy` (a share), which nine of ten packings keep to then, if a lattice with that many cells
/// a diameter fits the box. Cells cost their fifth power, so the resolution takes what the time step's errors
/// leave: those get a third of the accuracy, in squares a ninth.
///
/// - cells a diameter: expected_permeability_error(), 2.5 to 8; a whole number of cells along each axis;
/// - time step: the largest with Mach² and half of the density difference in that third, Mach below 0.2 (the
///   run stops at 0.3), and a relaxation time of at most 1 (above, velocities lag near walls);
/// - float, whose five digits agree with double's, where the water moves by more than 1e-4 cells a step, as
///   slower water loses digits, and half a per cent or more is asked for;
/// - `trt_comoving` where grains move faster than two viscosities a cell: the drag of beds that carry their
///   water grows with the square of that speed with `trt`, 7 % at 5 (docs/decisions/solid-operator.md).
///
/// A UserError where no such settings exist: below 1.4 % packings are not known well enough, above 20 %
/// grains are not resolved at all; without any velocity; no spacing fits the box.
AccuracyChoice choose_for_accuracy(double accuracy, const AccuracyScene& scene);

/// The settings for so many cells a diameter, whatever their error; nothing is refused but a box that fits no
/// spacing.
AccuracyChoice choice_with_cells(double cells, double accuracy, const AccuracyScene& scene);

/// The largest spacing up to `most` that divides all three axes into whole cells, at least three quarters of
/// it; 0 where there is none.
double fitting_spacing(const Vec3& size, double most);

/// Speed of a sphere that falls or rises alone, m/s (key: fergusonchurch2004): R g d²/(18 ν + √(0.3 R g d³)),
/// R = |ρ_s/ρ_f − 1|.
double free_settling_velocity(double diameter, double density_ratio, double gravity, double viscosity);

}  // namespace suffuse::coupling
