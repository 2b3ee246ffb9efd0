#include "suffuse/coupling/accuracy_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "suffuse/common/error.h"
#include "suffuse/coupling/automatic_coefficient.h"
#include "suffuse/coupling/effects.h"
#include "suffuse/coupling/methods/averaged_settings.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kWho = "lbm accuracy";
constexpr double kLeastCells = 2, kMostCells = 8, kStepOfCells = 0.05;
/// Beds of free grains were shown to rest, and to fluidise at Terzaghi's gradient, on no fewer
/// (docs/decisions/virtual-mass.md).
constexpr double kLeastCellsOfFreeGrains = 2.8;
constexpr double kFinest = 0.014, kCoarsest = 0.3;
/// Share of the accuracy that the time step's errors may take.
constexpr double kShareOfTimeStep = 1. / 3;
constexpr double kLargestMach = 0.2, kLargestRelaxationTime = 1;
constexpr double kFloatFrom = 0.005, kLeastCellsAStep = 1e-4;
/// Most error of the drag of grains that carry their water, over their speed in viscosities a cell: with TRT
/// it grows with its square, with the operator that relaxes moments about the cell's own velocity as it does
/// (docs/results/data/solid_operator_comoving.csv).
constexpr double kErrorOfSquare = 0.002, kComovingError = 0.0022;

double squared(double value) {
  return value * value;
}

double distance_from_whole(double value) {
  return std::abs(value - std::max(1., std::round(value)));
}

/// Diameters a cell of the averaged flow: what is tried, in this order.
constexpr double kDiameters[] = {3, 2.25, 4, 5.3, 6};
/// Its steps: shares of a grain's fall by its diameter, of a cell that the fastest water passes, and of the
/// time in which a flow past a grain starts, d^2/nu.
constexpr double kShareOfFall = 1. / 30, kCellsAStep = 0.1, kShareOfStart = 0.1;

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
  return std::sqrt(squared(resolution) + squared(compressibility) + squared(density) + squared(motion) +
                   squared(forces) + squared(closure) + squared(surface));
}

double expected_mach(const AccuracyScene& scene, double spacing, double time_step) {
  return std::sqrt(3.) * std::max(scene.velocity, scene.grain_speed) * time_step / spacing;
}

AccuracyErrors expected_errors(const AccuracyScene& scene, double spacing, double time_step,
                               lbm::CollisionOperator collision) {
  AccuracyErrors errors;
  if (scene.counted_diameter > 0)
    errors.resolution =
        expected_permeability_error(scene.counted_diameter / spacing,
                                    scene.solid_fraction > 0 ? scene.solid_fraction : kUsualSolidFraction);
  errors.compressibility = squared(expected_mach(scene, spacing, time_step));
  errors.density = 1.5 * scene.pressure_range / scene.density * squared(time_step / spacing);
  const bool comoving = collision == lbm::CollisionOperator::trt_comoving;
  const double fast = scene.grain_speed * spacing / scene.viscosity;
  errors.motion = comoving ? kComovingError * fast : kErrorOfSquare * squared(fast);
  if (scene.response_time > 0) errors.coupling = 0.5 * time_step / scene.response_time;
  return errors;
}

double softness_error(double solid_fraction, double stiffness_number) {
  const double porosity = 1 - solid_fraction;
  return (3 / porosity + 2 / solid_fraction) * 3 * solid_fraction / stiffness_number;
}

double least_stiffness_number(double share, double solid_fraction) {
  constexpr double of_contacts = 1. / 3;
  return softness_error(solid_fraction, 1) / (of_contacts * share);
}

double counted_diameter(double fine, double sauter) {
  constexpr double of_fines = 0.55, of_mean = 0.7;
  const double mean_counts = std::clamp((fine / sauter - of_fines) / (of_mean - of_fines), 0., 1.);
  return fine + mean_counts * std::max(0., sauter - fine);
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

AccuracyChoice choice_with_cells(double cells, const AccuracyWish& wish, const AccuracyScene& scene) {
  AccuracyChoice choice;
  choice.spacing = fitting_spacing(scene.size, scene.counted_diameter / cells);
  if (choice.spacing <= 0)
    throw_user_error({kWho, "box",
                      fmt::format("{:g} x {:g} x {:g} m", scene.size[0], scene.size[1], scene.size[2]),
                      fmt::format("be whole numbers of one cell of {:.3g} m or three quarters of it",
                                  scene.counted_diameter / cells),
                      "round its sides to a common length"});
  choice.cells = scene.counted_diameter / choice.spacing;
  set_time_step(choice, wish.share, scene);
  set_operators(choice, wish.share, scene);
  choice.errors = expected_errors(scene, choice.spacing, choice.time_step, choice.collision);
  if (wish.of == AccuracyOf::forces) choice.errors.forces = expected_force_error(choice.cells);
  constexpr double kFloatCost = 0.6, kComovingCost = 1.18;
  choice.cost = 1 / (choice.spacing * choice.spacing * choice.spacing * choice.time_step);
  if (choice.precision == lbm::Precision::float_precision) choice.cost *= kFloatCost;
  if (choice.collision == lbm::CollisionOperator::trt_comoving) choice.cost *= kComovingCost;
  return choice;
}

namespace {

double averaged_spacing(const AccuracyScene& scene) {
  for (const double diameters : kDiameters) {
    const double spacing = fitting_spacing(scene.size, diameters * scene.sauter_diameter);
    if (spacing >= kLeastDiametersOfCell * scene.sauter_diameter) return spacing;
  }
  return 0;
}

double averaged_step(double spacing, const AccuracyScene& scene) {
  double step = std::min(kCellsAStep * spacing / std::max(scene.velocity, scene.grain_speed),
                         kShareOfStart * squared(scene.sauter_diameter) / scene.viscosity);
  if (scene.falling > 0)
    step = std::min(step, kShareOfFall * std::sqrt(2 * scene.smallest_diameter / scene.falling));
  return step;
}

double of_quantity(const AveragedErrors& errors, AccuracyOf of) {
  if (of == AccuracyOf::critical_gradient) return errors.critical_gradient;
  return errors.permeability;
}

void require_what_can_be_chosen(const AccuracyWish& wish, const AccuracyScene& scene) {
  if (!(wish.share >= kFinest && wish.share <= kCoarsest))
    throw_user_error({kWho, "accuracy", fmt::format("{:g} %", 100 * wish.share),
                      fmt::format("be {:g} to {:g} %", 100 * kFinest, 100 * kCoarsest),
                      "finer, no packing is known well enough to tell; coarser, the formulas of "
                      "docs/results/price_of_methods.md need no run"});
  if (!(scene.counted_diameter > 0))
    throw_user_error({kWho, "grains", "none", "be there before: cells are counted a grain",
                      "without grains write `lbm lattice` yourself"});
  if (!(scene.velocity > 0 || scene.grain_speed > 0))
    throw_user_error(
        {kWho, "velocity", "none", "be known",
         "write `max_velocity U`, or the `lbm boundary` and `lbm force` that drive the water before"});
}

/// Cells a diameter; the most that may be chosen where none fit, to be told what is amiss with the box.
double finest_that_fits(const AccuracyScene& scene) {
  for (double cells = kMostCells; cells > kLeastCells; cells -= kStepOfCells)
    if (fitting_spacing(scene.size, scene.counted_diameter / cells) > 0) return cells;
  return kMostCells;
}

double error_of_nine_in_ten(const AccuracyChoice& choice) {
  return kScatterOfPackings * choice.errors.together();
}

/// Rounded up to two digits: what is named as enough is enough.
std::string enough_percent(double share) {
  const double percent = 100 * share, digit = std::pow(10, std::floor(std::log10(percent)) - 1);
  return fmt::format("{:.2g} %", digit * std::ceil(percent / digit * (1 - 1e-12)));
}

[[noreturn]] void refuse_averaged(const AccuracyWish& wish, const AccuracyScene& scene) {
  const std::string why = why_not_averaged(wish, scene);
  const auto choice = averaged_choice(wish, scene);
  throw_user_error({kWho, "accuracy", fmt::format("{:g} %", 100 * wish.share),
                    choice ? fmt::format("be at least {} with `lbm method averaged`",
                                         enough_percent(error_of_nine_in_ten(*choice)))
                           : "be one that the averaged flow can have: " + why,
                    "drop `lbm method averaged`, or its drag law: the resolved flow is finer"});
}

}  // namespace

bool keeps_to(const AccuracyWish& wish, const AccuracyChoice& choice) {
  return error_of_nine_in_ten(choice) <= wish.share;
}

std::string why_not_averaged(const AccuracyWish& wish, const AccuracyScene& scene) {
  if (!wish.averaged) return "the script asks for the resolved flow";
  if (!scene.not_averaged.empty()) return scene.not_averaged;
  if (!(scene.solid_fraction > kLeastBed)) return "the grains are no bed, and its errors are those of beds";
  if (averaged_spacing(scene) <= 0)
    return fmt::format("no cells of {:g} to {:g} mean diameters divide the box", kLeastDiametersOfCell,
                       *std::max_element(std::begin(kDiameters), std::end(kDiameters)));
  return "";
}

std::optional<AccuracyChoice> averaged_choice(const AccuracyWish& wish, const AccuracyScene& scene) {
  if (!why_not_averaged(wish, scene).empty()) return std::nullopt;
  AccuracyChoice choice;
  choice.averaged = true;
  choice.precision = lbm::Precision::double_precision;
  choice.spacing = averaged_spacing(scene);
  choice.cells = scene.counted_diameter / choice.spacing;
  choice.time_step = averaged_step(choice.spacing, scene);
  const AveragedErrors errors = averaged_errors(wish.drag);
  choice.errors.closure = of_quantity(errors, wish.of);
  if (wish.of == AccuracyOf::forces) choice.errors.forces = errors.forces;
  if (wish.of != AccuracyOf::critical_gradient && scene.bed_length > 0)
    choice.errors.surface =
        scene.free_surfaces * surface_loss(scene.solid_fraction) * choice.spacing / scene.bed_length;
  return choice;
}

double least_cells(const AccuracyScene& scene) {
  return scene.falling > 0 ? kLeastCellsOfFreeGrains : kLeastCells;
}

std::optional<AccuracyChoice> resolved_choice(const AccuracyWish& wish, const AccuracyScene& scene) {
  for (double cells = least_cells(scene); cells <= kMostCells + 1e-9; cells += kStepOfCells) {
    if (fitting_spacing(scene.size, scene.counted_diameter / cells) <= 0) continue;
    const AccuracyChoice choice = choice_with_cells(cells, wish, scene);
    if (keeps_to(wish, choice)) return choice;
  }
  return std::nullopt;
}

AccuracyChoice choose_for_accuracy(const AccuracyWish& wish, const AccuracyScene& scene) {
  require_what_can_be_chosen(wish, scene);
  const std::optional<AccuracyChoice> averaged = averaged_choice(wish, scene);
  if (averaged && keeps_to(wish, *averaged)) return *averaged;
  if (!wish.resolved) refuse_averaged(wish, scene);
  if (const auto resolved = resolved_choice(wish, scene)) return *resolved;
  const double cells = finest_that_fits(scene);
  const AccuracyChoice finest = choice_with_cells(cells, wish, scene);
  const AccuracyErrors& errors = finest.errors;
  throw_user_error(
      {kWho, "accuracy", fmt::format("{:g} %", 100 * wish.share),
       fmt::format("be at least {}, what {:.2g} cells a diameter give here",
                   enough_percent(error_of_nine_in_ten(finest)), finest.cells),
       errors.motion > errors.resolution ? "grains move too fast for finer: see `lbm collision`" : ""});
}

double free_settling_velocity(double diameter, double density_ratio, double gravity, double viscosity) {
  const double pull = std::abs(density_ratio - 1) * gravity;
  if (!(diameter > 0) || pull == 0) return 0;
  return pull * diameter * diameter /
         (18 * viscosity + std::sqrt(0.75 * 0.4 * pull * diameter * diameter * diameter));
}

}  // namespace suffuse::coupling
