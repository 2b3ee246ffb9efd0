#include "lbm_accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../liggghts/instance.h"
#include "driven_scene.h"
#include "run_price.h"
#include "styles/style_support.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/variable_file.h"

namespace suffuse::coupling {

namespace {

/// The settings that a choice stands for, in the place of `lbm method` and `lbm lattice`.
void take(const AccuracyChoice& choice, const AccuracyWish& wish, const AccuracyScene& scene,
          LbmRequest& settings) {
  lbm::UnitsRequest& units = settings.units;
  units.spacing = choice.spacing;
  units.mach.reset();
  units.largest_velocity = scene.velocity;
  units.only_cells_and_steps = choice.averaged;
  units.relaxation_time.reset();
  units.time_step.reset();
  if (choice.averaged)
    units.time_step = choice.time_step;
  else
    units.relaxation_time = choice.relaxation_time;
  if (!settings.method_given) {
    settings.averaged.reset();
    if (choice.averaged) settings.averaged = AveragedSettings{wish.drag, true};
  }
  settings.precision = choice.precision;
  settings.collision.collision_operator = choice.collision;
  settings.lattice_given = true;
}

/// Of one second of the flow, core seconds.
struct PricedChoice {
  AccuracyChoice choice;
  double water = 0, grains = 0;

  double all() const { return water + grains; }
};

/// What is chosen between the next cheaper and the next dearer, by rising price.
std::vector<AccuracyChoice> choices_beside(const AccuracyChoice& chosen, const AccuracyWish& wish,
                                           const AccuracyScene& scene) {
  std::vector<AccuracyChoice> choices;
  const auto add = [&](double cells) {
    if (fitting_spacing(scene.size, scene.counted_diameter / cells) > 0)
      choices.push_back(choice_with_cells(cells, wish, scene));
  };
  if (const auto averaged = averaged_choice(wish, scene)) choices.push_back(*averaged);
  double cells = chosen.cells;
  if (chosen.averaged) {
    const auto resolved = resolved_choice(wish, scene);
    if (!resolved) return choices;
    cells = resolved->cells;
  } else {
    if (const double fewer = std::max(0.8 * cells, least_cells(scene)); fewer < 0.95 * cells) add(fewer);
  }
  add(cells);
  add(1.25 * cells);
  return choices;
}

RunPrice price_of(LAMMPS_NS::LAMMPS* lmp, const AccuracyChoice& choice, const AccuracyWish& wish,
                  const AccuracyScene& scene, LbmRequest settings, LiggghtsPort& port) {
  settings.method_given = false;
  take(choice, wish, scene, settings);
  return price_of_run(lmp, settings, port);
}

/// Of the averaged flow, by a trial. None where it refuses the scene (grains larger than its cells may leave
/// no room for water): the resolved flow is looked at then, and `scene` knows why.
std::optional<PricedChoice> priced_averaged(LAMMPS_NS::LAMMPS* lmp, const AccuracyWish& wish,
                                            AccuracyScene& scene, const LbmRequest& settings,
                                            LiggghtsPort& port) {
  const auto choice = averaged_choice(wish, scene);
  if (!choice) return std::nullopt;
  try {
    const RunPrice price = price_of(lmp, *choice, wish, scene, settings, port);
    return PricedChoice{*choice, price.water, price.grains};
  } catch (const UserError& refusal) {
    if (!wish.resolved) throw;
    scene.not_averaged = fmt::format("cells of {:.3g} m were refused ({})", choice->spacing, refusal.what());
    return std::nullopt;
  }
}

/// By the trial of the averaged flow and one of the coarsest lattice; finer ones cost as many times as much
/// as `lbm plan` says of other resolutions.
std::vector<PricedChoice> priced(LAMMPS_NS::LAMMPS* lmp, const std::vector<AccuracyChoice>& choices,
                                 const std::optional<PricedChoice>& averaged, const AccuracyWish& wish,
                                 const AccuracyScene& scene, const LbmRequest& settings, LiggghtsPort& port) {
  std::vector<PricedChoice> priced;
  double water_at_cost = 0, grains = 0;
  for (const AccuracyChoice& choice : choices) {
    if (choice.averaged) {
      priced.push_back(averaged.value());
      continue;
    }
    if (water_at_cost == 0) {
      const RunPrice price = price_of(lmp, choice, wish, scene, settings, port);
      water_at_cost = price.water / choice.cost, grains = price.grains;
    }
    priced.push_back({choice, water_at_cost * choice.cost, grains});
  }
  return priced;
}

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

const char* name_of(AccuracyOf of) {
  switch (of) {
    case AccuracyOf::critical_gradient:
      return "critical gradient";
    case AccuracyOf::forces:
      return "forces on single grains";
    default:
      return "permeability";
  }
}

/// Of an averaged flow.
std::string sources_of(const AccuracyErrors& errors) {
  std::string text = "its drag law " + percent(errors.closure);
  if (errors.surface > 0) text += ", the bed's surface " + percent(errors.surface);
  if (errors.forces > 0) text += ", single grains " + percent(errors.forces);
  return text;
}

std::string method_line(const AccuracyChoice& choice, const AccuracyWish& wish, const AccuracyScene& scene) {
  std::string text = fmt::format("lbm accuracy: method     {}: ", choice.averaged ? "averaged" : "resolved");
  const auto averaged = averaged_choice(wish, scene);
  if (choice.averaged) return text + sources_of(choice.errors) + "\n";
  if (!averaged) return text + "not averaged, for " + why_not_averaged(wish, scene) + "\n";
  return text + fmt::format("the averaged flow errs by about {}: {}\n", percent(averaged->errors.together()),
                            sources_of(averaged->errors));
}

std::string lattice_lines(const AccuracyChoice& choice, const AccuracyScene& scene, const AccuracyWish& wish,
                          const std::string& region) {
  const std::string where = region.empty() ? "" : " region " + region;
  if (choice.averaged)
    return fmt::format("lbm method averaged drag {}`, `lbm lattice spacing {} timestep {} max_velocity {}{}",
                       coupling::name_of(wish.drag), choice.spacing, choice.time_step, scene.velocity, where);
  return fmt::format("lbm lattice spacing {} relaxation_time {} max_velocity {} precision {}{}",
                     choice.spacing, choice.relaxation_time, scene.velocity,
                     choice.precision == lbm::Precision::float_precision ? "float" : "double", where);
}

std::string averaged_lines(const AccuracyChoice& choice, const AccuracyScene& scene) {
  return fmt::format(
      "lbm accuracy: cells      {:.4g} m, {:.2g} mean diameters\n"
      "lbm accuracy: time step  {:.4g} s at {:.3g} m/s\n",
      choice.spacing, choice.spacing / scene.sauter_diameter, choice.time_step, scene.velocity);
}

std::string resolved_lines(const AccuracyChoice& choice, const AccuracyScene& scene,
                           const std::string& velocity_from) {
  const AccuracyErrors& errors = choice.errors;
  std::string text =
      fmt::format("lbm accuracy: cells      {:.3g} a diameter ({:.4g} m): {}, worst packing tried {}\n",
                  choice.cells, scene.counted_diameter, percent(errors.resolution),
                  percent(largest_permeability_error(choice.cells, scene.solid_fraction)));
  if (errors.forces > 0)
    text += fmt::format("lbm accuracy: forces     {} on single grains besides\n", percent(errors.forces));
  text += fmt::format(
      "lbm accuracy: time step  {:.4g} s, bound by {}: Mach number {:.2g} ({}) at {:.3g} m/s, {}; density "
      "{}\n",
      choice.time_step, choice.bound, choice.mach, percent(errors.compressibility), scene.velocity,
      velocity_from, percent(errors.density));
  text += fmt::format("lbm accuracy: precision  {}\n",
                      choice.precision == lbm::Precision::float_precision
                          ? "float: five digits are the same"
                          : "double: slow water, or fine accuracy, would lose digits");
  if (errors.motion > 0)
    text += fmt::format("lbm accuracy: collision  {}: grains at {:.2g} viscosities a cell ({})\n",
                        lbm::name_of(choice.collision), scene.grain_speed * choice.spacing / scene.viscosity,
                        percent(errors.motion));
  return text;
}

/// How stiff the contacts are, and would have to be. The script's grains have settled with them by now.
std::string stiffness_line(const AccuracyWish& wish, const AccuracyScene& scene) {
  if (!(scene.stiffness_number > 0)) return "";
  const double enough = least_stiffness_number(wish.share, scene.solid_fraction);
  const double factor =
      std::pow(enough / scene.stiffness_number, 1.5);  // kappa ~ E^(2/3) of Hertz's contacts
  return fmt::format(
      "lbm accuracy: stiffness  kappa {:.3g} under the bed's weight in water, {:.3g} Pa: {} of the "
      "permeability; "
      "{}: {:.2g} times the modulus, DEM steps {:.2g} times as long\n",
      scene.stiffness_number, scene.bed_stress,
      percent(softness_error(scene.solid_fraction, scene.stiffness_number)),
      factor > 1 ? fmt::format("too soft, {:.3g} would do", enough) : fmt::format("{:.3g} would do", enough),
      factor, 1 / std::sqrt(factor));
}

/// Trials of a few steps tell prices no better than that.
constexpr double kSamePrice = 1.3;

/// The cheapest that keeps to what was asked for, and of what costs the same the most accurate; `chosen`
/// where none of them is known to.
AccuracyChoice cheapest(const std::vector<PricedChoice>& choices, const AccuracyWish& wish,
                        const AccuracyChoice& chosen) {
  const auto serves = [&](const PricedChoice& priced) {
    return keeps_to(wish, priced.choice) && (wish.resolved || priced.choice.averaged);
  };
  double least = std::numeric_limits<double>::infinity();
  for (const PricedChoice& priced : choices)
    if (serves(priced)) least = std::min(least, priced.all());
  const PricedChoice* best = nullptr;
  for (const PricedChoice& priced : choices)
    if (serves(priced) && priced.all() <= kSamePrice * least &&
        (best == nullptr || priced.choice.errors.together() < best->choice.errors.together()))
      best = &priced;
  return best == nullptr ? chosen : best->choice;
}

/// By rising price: error, core seconds a second of the flow, times the chosen one's.
std::string prices_text(std::vector<PricedChoice> choices, const AccuracyChoice& chosen) {
  const auto by_price = [](const PricedChoice& a, const PricedChoice& b) { return a.all() < b.all(); };
  std::sort(choices.begin(), choices.end(), by_price);
  const auto is_chosen = [&](const PricedChoice& priced) {
    return priced.choice.averaged == chosen.averaged && priced.choice.spacing == chosen.spacing;
  };
  const auto place = std::find_if(choices.begin(), choices.end(), is_chosen);
  std::string text = fmt::format("lbm accuracy: {:<11}{:<26}{:>7}{:>12}{:>12}{:>8}\n", "choice", "", "error",
                                 "water", "grains", "price");
  for (auto priced = choices.begin(); priced != choices.end(); ++priced) {
    const AccuracyChoice& choice = priced->choice;
    const std::string what = choice.averaged ? fmt::format("averaged, {:.3g} m a cell", choice.spacing)
                                             : fmt::format("{:.3g} cells a diameter", choice.cells);
    text += fmt::format("lbm accuracy: {:<11}{:<26}{:>7}{:>12.3g}{:>12.3g}{:>8.2g}\n",
                        priced == place  ? "this"
                        : priced < place ? "cheaper"
                                         : "dearer",
                        what, percent(choice.errors.together()), priced->water, priced->grains,
                        priced->all() / place->all());
  }
  return text + "lbm accuracy: water and grains in core seconds for a second of the flow\n";
}

}  // namespace

void set_accuracy(LAMMPS_NS::LAMMPS* lmp, const AccuracyRequest& request, LiggghtsPort& port,
                  LbmRequest& settings) {
  auto [scene, velocity_from] = driven_scene(lmp, port, settings, request.largest_velocity, request.region);
  AccuracyWish wish{request.accuracy.value(), request.of};
  if (settings.method_given) {
    wish.averaged = settings.averaged.has_value();
    wish.resolved = !wish.averaged;
    if (wish.averaged) wish.drag = settings.averaged->drag;
  }
  if (!settings.averaged && !settings.solids.errors_are_known())
    throw_user_error({"lbm accuracy", "solid operator",
                      fmt::format("{}, coefficient {}", lbm::name_of(settings.solids.cells.solid_operator),
                                  settings.solids.automatic_coefficient ? "auto" : "given"),
                      "be force with weighting viscosity_independent and coefficient auto: no errors were "
                      "measured with others",
                      "drop the line `lbm solid` or `lbm preset`, or set `lbm lattice` by hand"});
  AccuracyChoice first = choose_for_accuracy(wish, scene);
  settings.region = request.region;
  const auto averaged = priced_averaged(lmp, wish, scene, settings, port);
  if (first.averaged && !averaged) first = choose_for_accuracy(wish, scene);
  const std::vector<PricedChoice> choices =
      priced(lmp, choices_beside(first, wish, scene), averaged, wish, scene, settings, port);
  const AccuracyChoice choice = cheapest(choices, wish, first);
  take(choice, wish, scene, settings);
  std::string text = fmt::format("lbm accuracy: {} of the {} asked for, about {} to be expected\n",
                                 percent(wish.share), name_of(wish.of), percent(choice.errors.together()));
  text += method_line(choice, wish, scene);
  text += choice.averaged ? averaged_lines(choice, scene) : resolved_lines(choice, scene, velocity_from);
  text += stiffness_line(wish, scene);
  text += prices_text(choices, choice);
  tell(lmp,
       text + "lbm accuracy: the same is `" + lattice_lines(choice, scene, wish, request.region) + "`\n");
}

void write_lattice(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, const std::string& file) {
  const lbm::Units units(settings.units);
  const double spacing = units.spacing(), step = units.time_step();
  constexpr double incompressible = 1e9;
  const double sound = settings.averaged ? incompressible : spacing / step / std::sqrt(3.);
  const std::string who = "lbm accuracy";
  on_first_rank(who, communicator_of(lmp), [&] {
    const std::pair<const char*, std::optional<double>> variables[] = {
        {"lattice_spacing", spacing}, {"lattice_timestep", step}, {"lattice_sound", sound}};
    write_variable_file(file, variables, who);
  });
}

}  // namespace suffuse::coupling
