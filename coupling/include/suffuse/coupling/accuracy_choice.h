#pragma once

#include <optional>
#include <string>

#include "suffuse/coupling/method_errors.h"
#include "suffuse/lbm/fluid.h"

namespace suffuse::coupling {

/// What a scene is like, for settings of a wanted accuracy; SI.
struct AccuracyScene {
  double counted_diameter = 0;  ///< counted_diameter() of the grains, m; 0 without grains
  double velocity = 0;          ///< of the fastest water expected, m/s
  double grain_speed = 0;       ///< of the fastest grains expected, m/s; 0 where none moves
  double pressure_range = 0;    ///< largest difference of pressures in the water, Pa
  double density = 1000;        ///< kg/m³
  double viscosity = 1e-6;      ///< kinematic, m²/s
  double response_time = 0;     ///< in which the smallest grain follows its water, s; 0 where none moves
  Vec3 size = Vec3::Zero();     ///< of the fluid's box, m
  // What the averaged flow goes by
  double sauter_diameter = 0;    ///< m
  double solid_fraction = 0;     ///< of the smallest box around the grains
  double bed_length = 0;         ///< along the flow, m
  int free_surfaces = 0;         ///< of the bed, with water beyond, across the flow
  double falling = 0;            ///< acceleration of a free grain in the water, m/s^2; 0 where none moves
  double smallest_diameter = 0;  ///< m
  double bed_stress = 0;         ///< weight in water of a bed that may move, over its area, Pa; else 0
  double stiffness_number = 0;   ///< diameter over typical overlap under it
  std::string not_averaged;      ///< what of the script the averaged flow has not; empty: nothing
};

/// What is asked for.
struct AccuracyWish {
  double share = 0.03;
  AccuracyOf of = AccuracyOf::permeability;
  bool resolved = true, averaged = true;  ///< which flows may be chosen
  DragLaw drag = DragLaw::beetstra;       ///< of the averaged flow
};

/// Errors by source, shares of the permeability or of a speed.
struct AccuracyErrors {
  double resolution = 0;       ///< expected_permeability_error() at the counted diameter
  double compressibility = 0;  ///< Mach number squared
  double density = 0;          ///< half of the difference of densities that the pressures make
  double motion = 0;           ///< drag of grains that carry their water along
  double forces = 0;           ///< of single grains, beside that of the whole; 0 where not asked for
  double closure = 0;          ///< averaged flow: averaged_errors()
  double surface = 0;          ///< averaged flow: surface_loss() over the bed's length
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
  bool averaged = false;  ///< cells and step of the averaged flow; else of the lattice
  double cells = 0;       ///< a fine diameter
  double spacing = 0, time_step = 0, relaxation_time = 0;
  double mach = 0;
  lbm::Precision precision = lbm::Precision::float_precision;
  lbm::CollisionOperator collision = lbm::CollisionOperator::trt;
  AccuracyErrors errors;
  const char* bound = "";  ///< what keeps the time step from being larger
  /// Of the water of the resolved flow: cells times steps a second of the run's time, times what precision
  /// and operator make of it. Ratios of it are ratios of time.
  double cost = 0;
};

/// The cheapest settings of the default operators whose expected error (a root mean square) is so far below
/// the share that nine of ten packings keep to it then.
///
/// The averaged flow where it may be and keeps to the share, for it costs less than any lattice; else the
/// least cells a diameter that fit the box. Cells cost their fifth power, so the resolution takes what the
/// time step's errors leave: those get a third of the accuracy, in squares a ninth.
///
/// - cells a diameter: expected_permeability_error(), and expected_force_error() where forces are asked for;
///   2 to 8, and 2.8 or more where grains may move; a whole number of cells along each axis;
/// - time step: the largest with Mach² and half of the density difference in that third, Mach below 0.2 (the
///   run stops at 0.3), and a relaxation time of at most 1 (above, velocities lag near walls);
/// - float, whose five digits agree with double's, where the water moves by more than 1e-4 cells a step, as
///   slower water loses digits, and half a per cent or more is asked for;
/// - `trt_comoving` where grains move faster than three viscosities a cell: the drag of beds that carry their
///   water errs with the square of that speed with `trt`, by up to 5 % at 5
///   (docs/decisions/solid-operator.md).
///
/// A UserError where no such settings exist: below 1.4 % packings are not known well enough, above 30 %
/// grains are not resolved at all; without any velocity; no spacing fits the box.
AccuracyChoice choose_for_accuracy(const AccuracyWish& wish, const AccuracyScene& scene);

/// Is its expected error so far below the share that nine of ten packings keep to it?
bool keeps_to(const AccuracyWish& wish, const AccuracyChoice& choice);

/// Cells a diameter below which nothing is chosen: 2, or 2.8 where grains may move.
double least_cells(const AccuracyScene& scene);

/// The least cells a diameter that keep to the share; none where no lattice does.
std::optional<AccuracyChoice> resolved_choice(const AccuracyWish& wish, const AccuracyScene& scene);

/// The settings for so many cells a diameter, whatever their error; nothing is refused but a box that fits no
/// spacing.
AccuracyChoice choice_with_cells(double cells, const AccuracyWish& wish, const AccuracyScene& scene);

/// The averaged flow on cells of about three mean diameters, from 1.5 to 6, that divide the box; none where
/// there are no such cells, the grains are no bed (solid fraction below 0.3), or `not_averaged` says why.
/// Time step: a thirtieth of the time in which the smallest grain falls by its diameter, a tenth of d²/ν
/// with the mean diameter, or what the fastest water needs for a tenth of a cell, whichever is least.
std::optional<AccuracyChoice> averaged_choice(const AccuracyWish& wish, const AccuracyScene& scene);

/// Why averaged_choice() has none, in words; empty where it has one.
std::string why_not_averaged(const AccuracyWish& wish, const AccuracyScene& scene);

/// How far below the share asked for the expected error must lie.
inline constexpr double kScatterOfPackings = 1.3;
/// Solid fraction from which on grains are a bed, whose drag is Ergun's and which carries its water along.
inline constexpr double kLeastBed = 0.3;

/// Share by which soft contacts lower the permeability: overlaps of a diameter over kappa fill pores, the
/// porosity n falls by some 3 (1 - n)/kappa (docs/results/contact_stiffness.md: 2.5 to 3.4 over kappa at n =
/// 0.23), and k follows n^3/(1 - n)^2 (key: carman1937). No part of what a lattice errs by: the sample is as
/// it is.
double softness_error(double solid_fraction, double stiffness_number);

/// The least stiffness number with which that is a third of the share.
double least_stiffness_number(double share, double solid_fraction);

/// Diameter that cells are counted by, m: the mean (Sauter) of packings whose finest quarter of the surface
/// (fine_diameter.h) is no finer than 0.7 of it, as of those that the errors were measured on; of
/// beds with much finer grains, 0.55 of it or less, that of the finest quarter, whose pores they are
/// (tests/data/gap_graded_packings.csv).
double counted_diameter(double fine, double sauter);

/// The largest spacing up to `most` that divides all three axes into whole cells, at least three quarters of
/// it; 0 where there is none.
double fitting_spacing(const Vec3& size, double most);

/// Speed of a sphere that falls or rises alone, m/s (key: fergusonchurch2004): R g d²/(18 ν + √(0.3 R g d³)),
/// R = |ρ_s/ρ_f − 1|.
double free_settling_velocity(double diameter, double density_ratio, double gravity, double viscosity);

}  // namespace suffuse::coupling
