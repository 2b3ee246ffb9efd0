#include "suffuse/coupling/accuracy_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "suffuse/common/error.h"
#include "suffuse/coupling/automatic_coefficient.h"
#include "suffuse/coupling/effects.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kWho = "lbm accuracy";
constexpr double kLeastCells = 2.5, kMostCells = 8, kStepOfCells = 0.05;
constexpr double kFinest = 0.014, kCoarsest = 0.2;
/// Errors of single packings scatter about the root mean square: nine of ten stay below so many of it.
constexpr double kScatter = 1.5;
/// Share of the accuracy that the time step's errors may take.
constexpr double kShareOfTimeStep = 1. / 3;
constexpr double kLargestMach = 0.2, kLargestRelaxationTime = 1;
constexpr double kFloatFrom = 0.005, kLeastCellsAStep = 1e-4;
/// Error of the drag of grains at 5 viscosities a cell, with TRT and with the operator that relaxes moments
/// about the cell's own velocity.
constexpr double kMeasuredAt = 5, kErrorThere = 0.07, kComovingErrorThere = 0.03;

double squared(double value) {
  return value * value;
}

double distance_from_whole(double value) {
  return std::abs(value - std::max(1., std::round(value)));
}

/// Largest time step, and what bounds it.
void set_time_step(AccuracyChoice& choice, double accuracy, const AccuracyScene& scene) {
  const double dx = choice.spacing, share = accuracy * kShareOfTimeStep;
  struct Bound {
    const char* name;
    double step;
  };
  std::vector<Bound> bounds{
      {"the relaxation time", (kLargestRelaxationTime - 0.5) / 3 * dx * dx / scene.viscosity}};
  const double fastest = std::max(scene.velocity, scene.grain_speed);
  if (fastest > 0)
    bounds.push_back(
        {"the Mach number", std::min(std::sqrt(share), kLargestMach) * dx / (std::sqrt(3.) * fastest)});
  if (scene.pressure_range > 0)
    bounds.push_back(
        {"the density difference", dx * std::sqrt(2 * share * scene.density / (3 * scene.pressure_range))});
  const Bound least = *std::min_element(bounds.begin(), bounds.end(),
                                        [](const Bound& a, const Bound& b) { return a.step < b.step; });
  choice.bound = least.name;
  choice.time_step = least.step;
  choice.relaxation_time = 0.5 + 3 * scene.viscosity * choice.time_step / (dx * dx);
  choice.mach = expected_mach(scene, dx, choice.time_step);
}

void set_operators(AccuracyChoice& choice, double accuracy, const AccuracyScene& scene) {
  const double fast = scene.grain_speed * choice.spacing / scene.viscosity;
  const bool comoving = fast > kFastGrains.limit;
  choice.collision = comoving ? lbm::CollisionOperator::trt_comoving : lbm::CollisionOperator::trt;
  const double moves = scene.velocity * choice.time_step / choice.spacing;
  if (accuracy < kFloatFrom || moves < kLeastCellsAStep) choice.precision = lbm::Precision::double_precision;
}

}  // namespace

double AccuracyErrors::together() const {
  return std::sqrt(squared(resolution) + squared(compressibility) + squared(density) + squared(motion));
}

double expected_mach(const AccuracyScene& scene, double spacing, double time_step) {
  return std::sqrt(3.) * std::max(scene.velocity, scene.grain_speed) * time_step / spacing;
}

AccuracyErrors expected_errors(const AccuracyScene& scene, double spacing, double time_step,
                               lbm::CollisionOperator collision) {
  AccuracyErrors errors;
  if (scene.fine_diameter > 0) errors.resolution = expected_permeability_error(scene.fine_diameter / spacing);
  errors.compressibility = squared(expected_mach(scene, spacing, time_step));
  errors.density = 1.5 * scene.pressure_range / scene.density * squared(time_step / spacing);
  const bool comoving = collision == lbm::CollisionOperator::trt_comoving;
  const double fast = scene.grain_speed * spacing / scene.viscosity;
  errors.motion = (comoving ? kComovingErrorThere : kErrorThere) * squared(fast / kMeasuredAt);
  if (scene.response_time > 0) errors.coupling = 0.5 * time_step / scene.response_time;
  return errors;
}

double fitting_spacing(const Vec3& size, double most) {
  constexpr double kLeastShare = 0.75, kRounding = 1e-3;
  const auto first = static_cast<long>(std::ceil(size[0] / most - kRounding));
  const auto last = static_cast<long>(std::floor(size[0] / (kLeastShare * most)));
  for (long n = std::max(1L, first); n <= std::max(first, last); ++n) {
    const double spacing = size[0] / static_cast<double>(n);
    if (distance_from_whole(size[1] / spacing) <= kRounding &&
        distance_from_whole(size[2] / spacing) <= kRounding)
      return spacing;
  }
  return 0;
}

AccuracyChoice choice_with_cells(double cells, double accuracy, const AccuracyScene& scene) {
  AccuracyChoice choice;
  choice.spacing = fitting_spacing(scene.size, scene.fine_diameter / cells);
  if (choice.spacing <= 0)
    throw_user_error({kWho, "box",
                      fmt::format("{:g} x {:g} x {:g} m", scene.size[0], scene.size[1], scene.size[2]),
                      fmt::format("be whole numbers of one cell of {:.3g} m or three quarters of it",
                                  scene.fine_diameter / cells),
                      "round its sides to a common length"});
  choice.cells = scene.fine_diameter / choice.spacing;
  set_time_step(choice, accuracy, scene);
  set_operators(choice, accuracy, scene);
  choice.errors = expected_errors(scene, choice.spacing, choice.time_step, choice.collision);
  constexpr double kFloatCost = 0.6, kComovingCost = 1.18;
  choice.cost = 1 / (choice.spacing * choice.spacing * choice.spacing * choice.time_step);
  if (choice.precision == lbm::Precision::float_precision) choice.cost *= kFloatCost;
  if (choice.collision == lbm::CollisionOperator::trt_comoving) choice.cost *= kComovingCost;
  return choice;
}

AccuracyChoice choose_for_accuracy(double accuracy, const AccuracyScene& scene) {
  if (!(accuracy >= kFinest && accuracy <= kCoarsest))
    throw_user_error(
        {kWho, "accuracy", fmt::format("{:g} %", 100 * accuracy),
         fmt::format("be {:g} to {:g} %", 100 * kFinest, 100 * kCoarsest),
         "finer, no packing is known well enough to tell; coarser, take `lbm method averaged`, which errs by "
         "a third or less for a bed as a whole (docs/results/price_of_methods.md)"});
  if (!(scene.fine_diameter > 0))
    throw_user_error({kWho, "grains", "none", "be there before: cells are counted a grain",
                      "without grains write `lbm lattice` yourself"});
  if (!(scene.velocity > 0 || scene.grain_speed > 0))
    throw_user_error(
        {kWho, "velocity", "none", "be known",
         "write `max_velocity U`, or the `lbm boundary` and `lbm force` that drive the water before"});
  std::optional<AccuracyChoice> finest;
  for (double cells = kLeastCells; cells <= kMostCells + 1e-9; cells += kStepOfCells) {
    if (fitting_spacing(scene.size, scene.fine_diameter / cells) <= 0) continue;
    finest = choice_with_cells(cells, accuracy, scene);
    if (kScatter * finest->errors.together() <= accuracy) return *finest;
  }
  if (!finest) finest = choice_with_cells(kMostCells, accuracy, scene);  // tells what is amiss with the box
  const AccuracyErrors& errors = finest->errors;
  throw_user_error(
      {kWho, "accuracy", fmt::format("{:g} %", 100 * accuracy),
       fmt::format("be above {:.2g} %, what {:.2g} cells a diameter give here",
                   100 * kScatter * errors.together(), finest->cells),
       errors.motion > errors.resolution ? "grains move too fast for finer: see `lbm collision`" : ""});
}

double free_settling_velocity(double diameter, double density_ratio, double gravity, double viscosity) {
  const double pull = std::abs(density_ratio - 1) * gravity;
  if (!(diameter > 0) || pull == 0) return 0;
  return pull * diameter * diameter /
         (18 * viscosity + std::sqrt(0.75 * 0.4 * pull * diameter * diameter * diameter));
}

}  // namespace suffuse::coupling
