#include "lbm_plan.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "manifest.h"
#include "styles/style_support.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/progress.h"
#include "suffuse/coupling/automatic_coefficient.h"

namespace suffuse::coupling {

namespace {

bool is_calibrated(const CoupledSettings& settings) {
  return !settings.averaged && settings.solids.errors_are_known();
}

/// Error of the permeability where the coefficient is calibrated; empty otherwise.
std::string error_line(const CoupledSettings& settings, const AccuracyScene& scene, double spacing) {
  if (!is_calibrated(settings)) return "";
  const double cells = scene.counted_diameter / spacing;
  return fmt::format(
      "lbm plan: expected error of the permeability: about {:.0f} % (worst packing tried: {:.0f} %), by the "
      "{:.2g} cells a diameter of {:.3g} m (docs/reference/lbm.md#accuracy)\n",
      100 * expected_permeability_error(cells, scene.solid_fraction),
      100 * largest_permeability_error(cells, scene.solid_fraction), cells, scene.counted_diameter);
}

std::string scene_text(const CoupledSettings& settings, const lbm::Units& units, const lbm::Index3& cells,
                       const LiggghtsPort::Summary& grains, const AccuracyScene& scene, double time,
                       double steps, double bytes) {
  std::string text = fmt::format(
      "lbm plan: {:g} s are {:.0f} steps of {} x {} x {} cells, {} each; {:.3g} GB for the fluid\n", time,
      steps, cells[0], cells[1], cells[2], count_text(settings.substeps, "DEM step"), bytes * 1e-9);
  text += "lbm plan: " + units.summary() + "\n";
  for (const std::string& note : units.warnings())
    text += "lbm plan: note: " + note + " (docs/reference/lbm.md#fluid-lattice)\n";
  if (grains.grains == 0) return text;
  text += fmt::format("lbm plan: {}, {}\n", count_text(grains.grains, "grain"),
                      sizes_text(grains, units.spacing()));
  if (settings.averaged) return text;
  text += error_line(settings, scene, units.spacing());
  const std::string note = resolution_note(grains, units.spacing());
  return note.empty() ? text : text + "lbm plan: note: " + note + "\n";
}

std::string cost_table(const TrialCosts& costs, double steps, bool grains_known) {
  std::string text = fmt::format("{:<22}{:>12}{:>12}\n", "cost of", "ms a step", "in all");
  const auto row = [&](const char* name, double seconds) {
    text += fmt::format("{:<22}{:>12.3f}{:>12}\n", name, 1e3 * seconds, duration_text(seconds * steps));
  };
  row("fluid", costs.fluid);
  row("solid mapping", costs.mapping);
  row("forces on grains", costs.exchange);
  row("monitors and guards", costs.samples);
  row(grains_known ? "grains, as last run" : "grains, usual core", costs.grains);
  row("together", costs.water() + costs.grains);
  constexpr double disturbed = 0.9;
  if (costs.share < disturbed)
    text += fmt::format(
        "lbm plan: note: other programs took {:.0f} % of the trial's time; the times are those without "
        "them\n",
        100 * (1 - costs.share));
  return text;
}

/// The same flow with other cells and the same relaxation time: cells grow with the third power of the
/// resolution, steps with the second, and the grains' own steps stay.
std::string prices_text(const TrialCosts& costs, double steps, const AccuracyScene& scene, double spacing) {
  const double cells = scene.counted_diameter / spacing;
  const double water = costs.water() * steps;
  const double grains = costs.grains * steps;
  std::string text = fmt::format("{:<22}{:>12}{:>12}\n", "cells a diameter", "in all", "error");
  for (const int other : {2, 3, 4, 5, 6, 8, 10})
    text += fmt::format("{:<22}{:>12}{:>10.1f} %\n", other,
                        duration_text(water * std::pow(other / cells, 5) + grains),
                        100 * expected_permeability_error(other, scene.solid_fraction));
  return text;
}

/// What the settings are expected to err by, source after source. The resolution's is that of the calibrated
/// coefficient; what contacts' softness changes is told by `dem_timestep`.
std::string errors_table(const CoupledSettings& settings, const DrivenScene& driven,
                         const lbm::Units& units) {
  const AccuracyScene& scene = driven.scene;
  const double spacing = units.spacing(), step = units.time_step();
  const lbm::CollisionOperator collision = settings.effects.comoving == Switch::on
                                               ? lbm::CollisionOperator::trt_comoving
                                               : settings.fluid.collision.collision_operator;
  AccuracyErrors errors = expected_errors(scene, spacing, step, collision);
  const bool calibrated = is_calibrated(settings);
  if (!calibrated) errors.resolution = 0;
  std::string text = fmt::format("{:<22}{:>12}\n", "error expected by", "about");
  const auto row = [&](const char* name, double error, const std::string& why) {
    text += fmt::format("{:<22}{:>10.2g} %  {}\n", name, 100 * error, why);
  };
  if (errors.resolution > 0)
    row("resolution", errors.resolution,
        fmt::format("{:.2g} cells a diameter of {:.3g} m", scene.counted_diameter / spacing,
                    scene.counted_diameter));
  if (scene.velocity > 0)
    row("compressibility", errors.compressibility,
        fmt::format("Mach number {:.2g} at {:.3g} m/s, {}", expected_mach(scene, spacing, step),
                    scene.velocity, driven.velocity_from));
  if (scene.pressure_range > 0)
    row("density", errors.density, fmt::format("pressures differ by {:.3g} Pa", scene.pressure_range));
  if (scene.grain_speed > 0 && !settings.averaged)
    row("carried water", errors.motion,
        fmt::format("grains at {:.2g} viscosities a cell, {}", scene.grain_speed * spacing / scene.viscosity,
                    name_of(collision)));
  if (!calibrated)
    text += fmt::format("{:<22}{:>12}  {}\n", "resolution", "not known",
                        "measured with operator force weighting viscosity_independent coefficient auto");
  row(calibrated ? "together" : "the others together", errors.together(),
      "of the permeability, or a steady speed");
  if (errors.coupling > 0)
    row("coupling", errors.coupling,
        fmt::format("while speeds change: half a step over the {:.2g} s in which the smallest grain follows",
                    scene.response_time));
  return text;
}

}  // namespace

void print_plan(LAMMPS_NS::LAMMPS* lmp, const RunPrice& price, const LiggghtsPort& port,
                const DrivenScene& driven, double time) {
  const CoupledSettings& settings = price.settings;
  const lbm::Units units(settings.units);
  const LiggghtsPort::Summary grains = port.summary();
  const double steps = std::max(1., std::round(units.time_to_lattice(time)));
  const AccuracyScene& scene = driven.scene;
  tell(lmp, scene_text(settings, units, price.cells, grains, scene, time, steps, price.costs.bytes) +
                cost_table(price.costs, steps, price.grains_known) +
                (grains.grains > 0 && !settings.averaged ? errors_table(settings, driven, units) : "") +
                (is_calibrated(settings) && scene.counted_diameter > 0
                     ? prices_text(price.costs, steps, scene, units.spacing())
                     : ""));
}

}  // namespace suffuse::coupling
