#include "verdict/fluidisation_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "grading/criteria_table.h"
#include "grading/hydraulic_table.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/constraint_ratio.h"
#include "suffuse/micromechanics/fluidisation.h"
#include "suffuse/micromechanics/layers.h"
#include "suffuse/micromechanics/seepage.h"
#include "verdict/flow_record.h"
#include "verdict/fluidisation_layers.h"
#include "verdict/onset_table.h"
#include "verdict/result_outputs.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

constexpr const char* kFluidisation = "fluidisation";

struct FluidisationOptions : SeepageOptions {
  ResultOutputs outputs;
  std::string file, grading, onset;
  std::vector<double> window{0.2, 0.8};
  FluidisationSettings settings;
  std::optional<double> porosity, height;
  LayerOptions layers;
};

void check(const FluidisationOptions& options) {
  const auto must = [](bool fine, const char* option, double value, const char* rule) {
    if (!fine) throw_user_error({kFluidisation, option, fmt::format("{:g}", value), rule, ""});
  };
  options.check(kFluidisation);
  must(options.window[0] >= 0 && options.window[0] < options.window[1], "--window", options.window[0],
       "be LOW HIGH, 0 <= LOW < HIGH");
  must(options.settings.rise_share > 0 && options.settings.rise_share < 1, "--rise",
       options.settings.rise_share, "be between 0 and 1");
  if (options.porosity)
    must(*options.porosity > 0 && *options.porosity < 1, "--porosity", *options.porosity,
         "be between 0 and 1");
  if (options.height) must(*options.height > 0, "--height", *options.height, "be > 0");
  must(options.layers.friction >= 0, "--friction", options.layers.friction, "be >= 0");
  const bool writes =
      !options.layers.measures.empty() || !options.layers.distributions.empty() || !options.onset.empty();
  if (writes && options.layers.files.empty())
    throw_user_error({kFluidisation, "--measures, --distributions, --onset", "without --dumps",
                      "have dumps to be made from", "add --dumps 'grains.*.dump' 'contacts.*.dump'"});
}

/// A run, read and measured.
struct Run {
  FlowRecord record;
  std::vector<FlowState> states;  ///< the samples of a ramp; at rest and the stages of held gradients
  std::vector<double> gradient;   ///< over the bed, of the states
  std::size_t stages = 0;         ///< 0: a ramp
  std::vector<std::size_t> sample_of_state;
  double terzaghi = 0;
  std::optional<double> of_all_grains;  ///< Terzaghi's, with what sticks out above the layers
  Fluidisation result;
};

/// Held stages if the driving gradient stands still in most samples, at three or more values; else a ramp.
std::vector<Hold> stages_of(const FlowRecord& record) {
  if (!record.has_driving) return {};
  const std::vector<Hold> holds = holds_of(record.driving);
  std::size_t held = 0;
  for (const auto& [first, last] : holds) held += last - first + 1;
  return holds.size() >= 3 && 2 * held > record.driving.size() ? holds : std::vector<Hold>{};
}

Run measured(const FluidisationOptions& options, const NumberTable& table) {
  Run run;
  run.record = flow_record(table, kFluidisation, options.height);
  if (options.porosity) run.record.porosity = *options.porosity;
  const auto& samples = run.record.states;
  const std::vector<Hold> holds = stages_of(run.record);
  FluidisationSettings settings = options.settings;
  settings.window_low = options.window[0];
  settings.window_high = options.window[1];
  if (holds.empty()) {
    run.states = samples;
    for (std::size_t k = 0; k < samples.size(); ++k) run.sample_of_state.push_back(k);
  } else {
    settings.window_slack = 0.02;
    run.stages = holds.size();
    run.states = held_states(samples, holds);
    for (const auto& [first, last] : holds) run.sample_of_state.push_back(last);
    if (holds.front().first > 0) {
      run.states.insert(run.states.begin(), samples.front());
      run.sample_of_state.insert(run.sample_of_state.begin(), 0);
    }
  }
  for (const FlowState& state : run.states) run.gradient.push_back(bed_gradient(state.gradient));
  run.terzaghi = critical_gradient(run.record.porosity, options.grain_density, options.fluid);
  if (run.record.solids_over_layers)
    run.of_all_grains =
        critical_gradient(1 - *run.record.solids_over_layers, options.grain_density, options.fluid);
  run.result = measure_fluidisation(run.states, run.terzaghi, run.record.height, settings);
  return run;
}

/// How far a gradient is from Terzaghi's, and from that of all grains where it is known.
std::string distance(const Run& run, double value) {
  std::string text = fmt::format("{:+.2f} % of Terzaghi's", 100 * (value / run.terzaghi - 1));
  if (run.of_all_grains)
    text += fmt::format(", {:+.2f} % of that of all grains", 100 * (value / *run.of_all_grains - 1));
  return text;
}

void add_state_at_rest(ResultRows& rows, const Run& run, const FluidisationOptions& options) {
  rows.add("porosity at rest", "n", run.record.porosity, "-",
           options.porosity ? "--porosity" : "first sample", "");
  rows.add("height at rest", "H", 1e3 * run.record.height, "mm", options.height ? "--height" : "first sample",
           run.stages > 0 ? fmt::format("{} held stages", run.stages)
                          : fmt::format("ramp, {} samples", run.states.size()));
}

void add_conductivity(ResultRows& rows, const Run& run, const FluidisationOptions& options) {
  const LineFit& line = run.result.flow;
  rows.add("conductivity, measured", "k", line.slope, "m/s", "line of v over i",
           fmt::format("{} states at i = {:g} to {:g} of Terzaghi's; standard error {:.2g} %", line.points,
                       options.window[0], options.window[1], 100 * line.slope_error / line.slope));
  if (options.grading.empty()) return;
  const Grading grading = grading_of_file(options.grading, kFluidisation);
  const GradingIndices sizes = grading_indices(grading);
  const double kozeny = conductivity_carman_kozeny(sizes.sauter, run.record.porosity, options.fluid);
  const auto unknown = [&](const char* name, const char* symbol, const char* source) {
    rows.add(name, symbol, std::nullopt, "m/s", source, "not applicable: " + curve_end(grading));
  };
  const auto beside = [&](const char* name, double value, const char* source, std::string note) {
    if (std::isnan(value)) return unknown(name, "k", source);
    rows.add(name, "k", value, "m/s", source,
             fmt::format("measured {:+.1f} % of it; {}", 100 * (line.slope / value - 1), note));
  };
  const std::string sauter = fmt::format("Sauter's size {:.4g} mm", 1e3 * sizes.sauter);
  beside("conductivity, Carman and Kozeny (180)", kozeny, "carman1939", sauter);
  beside("conductivity, Ergun's viscous term (150)", kozeny * 180 / 150, "ergun1952", sauter);
  beside("conductivity, Hazen", conductivity_hazen(sizes.d10), "hazen1892",
         fmt::format("d10 {:.4g} mm", 1e3 * sizes.d10));
  const double velocity = velocity_ergun(run.terzaghi, sizes.sauter, run.record.porosity, options.fluid);
  if (std::isnan(velocity)) return unknown("velocity at Terzaghi's gradient, Ergun", "v", "ergun1952");
  rows.add("velocity at Terzaghi's gradient, Ergun", "v", velocity, "m/s", "ergun1952",
           fmt::format("Re = v d/nu = {:.3g}", velocity * sizes.sauter / options.fluid.kinematic_viscosity));
}

/// Where motion begins, and how closely that is known: the crossing in a ramp; of stages the middle between
/// the last at rest and the first in motion, whose own gradient the moving bed cannot keep up, so that it is
/// taken from the driving one.
std::pair<double, double> onset_gradient(const Run& run) {
  const OnsetOfMotion& onset = *run.result.onset;
  if (run.stages == 0) return {onset.gradient, 0};
  const auto driving = [&](std::size_t state) { return run.record.driving[run.sample_of_state[state]]; };
  const double step = onset.last_at_rest * (driving(onset.state) / driving(onset.state - 1) - 1) / 2;
  return {onset.last_at_rest + step, step};
}

/// Appendix C's soil, by its Sauter size: what the thesis found holds for no other.
bool is_soil_of_thesis(const FluidisationOptions& options) {
  if (options.grading.empty()) return false;
  constexpr double sauter = 3.478e-4;  // m
  return std::abs(grading_indices(grading_of_file(options.grading, kFluidisation)).sauter / sauter - 1) <
         0.02;
}

void add_critical_gradients(ResultRows& rows, const Run& run, const FluidisationOptions& options) {
  const Fluidisation& result = run.result;
  rows.add("critical gradient, Terzaghi", "i_cr", run.terzaghi, "-", "terzaghi1943",
           "(rho_s/rho_f - 1)(1 - n) at the measured porosity");
  if (run.of_all_grains)
    rows.add("critical gradient, weight of all grains", "i_cr", *run.of_all_grains, "-", "terzaghi1943",
             "with those that stick out above the height of the layers");
  if (const auto& gradient = result.vanishes())
    rows.add("critical gradient, stress vanishes", "i_cr", *gradient, "-", "line of sigma' over i",
             fmt::format("standard error {:.2g} %; {}", 100 * result.stress->root_error() / *gradient,
                         distance(run, *gradient)));
  else if (result.stress)
    rows.add(
        "critical gradient, stress vanishes", "i_cr", std::nullopt, "-", "line of sigma' over i",
        "not applicable: the stress of the lowest layer does not fall along a line (walls carry the bed, or "
        "the run ends early)");
  if (result.onset) {
    const OnsetOfMotion& onset = *result.onset;
    const auto [gradient, half_width] = onset_gradient(run);
    rows.add(
        "critical gradient, bed begins to move", "i_cr", gradient, "-", "rise of the centre",
        distance(run, gradient) +
            (run.stages > 0
                 ? fmt::format(", within {:.4f}: middle of last stable and first unstable stage", half_width)
                 : std::string()));
    rows.add(fmt::format("gradient, centre risen by {:g} % of the height", 100 * options.settings.rise_share),
             "i", onset.risen, "-", "rise of the centre", "above the elastic rise, and stays there");
  } else {
    rows.add("critical gradient, bed begins to move", "i_cr", std::nullopt, "-", "rise of the centre",
             fmt::format("not reached; largest gradient {:.3f}", result.largest_gradient));
  }
  if (!is_soil_of_thesis(options)) return;
  rows.add("critical gradient, thesis, LBM-DEM", "i_cr", 1.050, "-", "haq, section 6.4",
           "porosity not printed");
  rows.add("critical gradient, thesis, semi-analytical", "i_cr", 1.133, "-", "haq, section 6.4",
           "does not follow from Terzaghi at its own porosity (needs n = 0.313)");
}

/// With and without the bottom layer, where it is one that touches the floor; the thesis leaves it out.
void add_homogeneity(ResultRows& rows, const Run& run) {
  const auto variance = layer_variance(run.record);
  if (!variance) return;
  rows.add("variance of the layers' void ratios", "S2", variance->all, "-", "jiang2003",
           "thesis: 2.72e-5 in ten layers");
  if (run.record.layers_on_floor)
    rows.add("  without the bottom layer", "S2", variance->upper, "-", "jiang2003", "");
}

/// What the contact network of the whole bed is like at the onset, where the monitor has it.
void add_contact_network(ResultRows& rows, const Run& run, const NumberTable& table) {
  struct Watched {
    const char *column, *name, *symbol;
  };
  constexpr Watched kWatched[] = {{"constraint_ratio", "constraint ratio", "R"},
                                  {"coordination_number", "coordination number", "Z"},
                                  {"sliding_share", "sliding contacts", "S_c"},
                                  {"broken_contacts", "broken contacts, net", "B_R"}};
  for (const Watched& watched : kWatched) {
    const auto* column = table.find(watched.column);
    if (!column) continue;
    std::vector<double> values;
    for (const std::size_t sample : run.sample_of_state) values.push_back((*column)[sample]);
    const bool is_ratio = watched.symbol == std::string("R");
    const auto verdict = [&](double value) {
      return is_ratio ? std::string(", ") + to_string(hydromechanical_state(value)) : std::string();
    };
    rows.add(fmt::format("{} at rest", watched.name), watched.symbol, values.front(), "-", "monitor",
             is_ratio ? std::string(to_string(hydromechanical_state(values.front()))) : "");
    if (run.result.onset) {
      const std::size_t before = run.result.onset->state - 1;
      rows.add(
          fmt::format("{} at the onset", watched.name), watched.symbol, values[before], "-", "monitor",
          fmt::format("last state at rest, i = {:.4f}{}", run.gradient[before], verdict(values[before])));
    }
    if (!is_ratio) continue;
    if (const auto fall = gradient_at_fall(run.gradient, values, 1, run.stages > 0 ? 1 : 3))
      rows.add("gradient at which R falls below 1", "i", *fall, "-", "haq, section 6.5.7",
               distance(run, *fall));
  }
}

void add_layers(ResultRows& rows, const Run& run, const FluidisationOptions& options) {
  for (std::size_t k = 0; k < run.result.layers.size(); ++k) {
    const LayerFluidisation& layer = run.result.layers[k];
    LayerRow row;
    row.layer = static_cast<int>(k) + 1;
    if (!run.record.layer_porosity.empty()) {
      row.porosity = run.record.layer_porosity[k];
      row.terzaghi = critical_gradient(*row.porosity, options.grain_density, options.fluid);
    }
    if (layer.flow) row.conductivity = layer.flow->slope;
    if (layer.stress) row.slope = layer.stress->slope;
    row.local = layer.local;
    row.by_lifting = layer.by_lifting;
    rows.add_layer(row);
  }
}

void write_onset(const FluidisationOptions& options, const Run& run, const LayerResults& layers) {
  OnsetOfRun onset;
  if (const auto variance = layer_variance(run.record))
    onset.variance = run.record.layers_on_floor ? variance->upper : variance->all;
  if (run.result.onset) {
    onset.gradient = onset_gradient(run).first;
    onset.lowest_gradient = run.states[run.result.onset->state - 1].gradient.back();
  }
  onset.thesis_soil = is_soil_of_thesis(options);
  SafeFile file(options.onset, "fluidisation --onset");
  file.write(onset_table(layers, onset));
  file.commit();
}

/// DEM step of the last state at rest.
std::optional<double> onset_step(const Run& run, const NumberTable& table) {
  const auto* steps = table.find("dem_step");
  if (!steps || !run.result.onset) return std::nullopt;
  return (*steps)[run.sample_of_state[run.result.onset->state - 1]];
}

ResultRows rows_of(const FluidisationOptions& options, const Run& run, const NumberTable& table) {
  ResultRows rows;
  add_state_at_rest(rows, run, options);
  add_homogeneity(rows, run);
  add_conductivity(rows, run, options);
  add_critical_gradients(rows, run, options);
  add_contact_network(rows, run, table);
  add_layers(rows, run, options);
  return rows;
}

/// As scripts take them; `none` where the stress has no gradient at which it vanishes.
Record variables_of(const Run& run, const NumberTable& table) {
  const auto first_of = [&](const std::vector<double>* column) {
    return column != nullptr ? std::optional(column->front()) : std::nullopt;
  };
  const auto coordination = table.numbered("coordination_layer_");
  return {{"measured_porosity", run.record.porosity},
          {"measured_sauter", first_of(table.find("sauter_diameter_m"))},
          {"conductivity", run.result.flow.slope},
          {"samples", static_cast<double>(run.result.flow.points)},
          {"stress_gradient", run.result.vanishes(), true},
          {"stress_gradient_found", run.result.vanishes() ? 1. : 0.},
          {"coordination_top", coordination.empty() ? std::nullopt : first_of(coordination.front())},
          {"coordination_bottom", coordination.empty() ? std::nullopt : first_of(coordination.back())}};
}

void run_command(FluidisationOptions& options) {
  check(options);
  std::vector<std::string> inputs = options.layers.files;
  inputs.insert(inputs.end(), {options.file, options.grading});
  options.outputs.require_new(kFluidisation, inputs);
  const NumberTable table(options.file, kFluidisation);
  const Run run = measured(options, table);
  const ResultRows rows = rows_of(options, run, table);
  std::string layers;
  if (!options.layers.files.empty()) {
    LayerResults results = layer_measures(options.layers, table, run.record, onset_step(run, table));
    if (!options.onset.empty()) write_onset(options, run, results);
    layers = std::move(results.text);
  }
  options.outputs.write(rows, kFluidisation, [&] { return variables_of(run, table); });
  fmt::print("{}{}", rows.text(), layers);
}

}  // namespace

ResultRows fluidisation_rows(const std::string& flow, const std::string& grading, double grain_density,
                             const SeepageFluid& fluid) {
  FluidisationOptions options;
  options.grading = grading;
  options.grain_density = grain_density;
  options.fluid = fluid;
  check(options);
  const NumberTable table(flow, kFluidisation);
  return rows_of(options, measured(options, table), table);
}

void add_fluidisation(CLI::App& app) {
  auto options = std::make_shared<FluidisationOptions>();
  CLI::App* command = app.add_subcommand(
      kFluidisation,
      "Porosity, conductivity, critical gradients of an upward-flow run, from its monitor file");
  command->add_option("FLOW", options->file, "CSV file of `lbm monitor`")->required();
  command->add_option("--grading,--grains", options->grading,
                      "grading: CSV file, or dump of the grains; for the formulas of conductivity");
  command
      ->add_option("--window", options->window,
                   "LOW HIGH: part of Terzaghi's gradient over which lines are fitted")
      ->expected(2)
      ->capture_default_str();
  command
      ->add_option("--rise", options->settings.rise_share,
                   "share of the bed's height by which its centre must rise for the bed to move")
      ->capture_default_str();
  command->add_option("--porosity", options->porosity, "of the bed at rest, instead of the first sample's");
  command->add_option("--height", options->height, "of the bed at rest, m, instead of the first sample's");
  CLI::Option* dumps = command->add_option(
      "--dumps", options->layers.files,
      "dumps of grains and contacts of the same run, patterns too: the contacts of its layers");
  options->outputs.add(*command, "--measures", options->layers.measures,
                       "CSV file: a row a snapshot and layer (needs --dumps)");
  options->outputs.add(*command, "--distributions", options->layers.distributions,
                       "CSV file: distributions of contacts a grain and of S_i (needs --dumps)");
  options->outputs.add(
      *command, "--onset", options->onset,
      "CSV file: the thesis's quantities at rest and as the bed begins to move (needs --dumps)");
  command->add_option("--bounds", options->layers.bounds, "LOW HIGH of the layers, m, for the dumps")
      ->expected(2)
      ->needs(dumps);
  command->add_option("--friction", options->layers.friction, "of the contacts in the dumps")
      ->capture_default_str()
      ->needs(dumps);
  options->add_to(*command);
  options->outputs.add_rows(*command);
  options->outputs.add_variables(*command, "file of `variable` lines for a script to include");
  command->callback([options] { run_command(*options); });
}

}  // namespace suffuse::analysis
