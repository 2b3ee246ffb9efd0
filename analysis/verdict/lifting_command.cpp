#include "verdict/lifting_command.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "grading/hydraulic_table.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/fluidisation.h"
#include "suffuse/micromechanics/seepage.h"
#include "verdict/flow_record.h"
#include "verdict/result_outputs.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

constexpr const char* kLifting = "lifting";

struct LiftingOptions : SeepageOptions {
  ResultOutputs outputs;
  std::string file;
  double diameter = 0;
  std::vector<double> window{0.2, 0.7};
};

void check(const LiftingOptions& options) {
  const auto must = [](bool fine, const char* option, double value, const char* rule) {
    if (!fine) throw_user_error({kLifting, option, fmt::format("{:g}", value), rule, ""});
  };
  must(options.diameter > 0, "--diameter", options.diameter, "be > 0");
  options.check(kLifting);
  must(options.window[0] >= 0 && options.window[0] < options.window[1], "--window", options.window[0],
       "be LOW HIGH, 0 <= LOW < HIGH");
}

void add_formula(ResultRows& rows, const char* name, double formula, double measured, const char* source,
                 std::string note) {
  rows.add(name, "v_mf", formula, "m/s", source,
           fmt::format("measured {:+.1f} % of it; {}", 100 * (measured / formula - 1), note));
}

void run(const LiftingOptions& options) {
  check(options);
  options.outputs.require_new(kLifting, {options.file});
  const NumberTable table(options.file, kLifting);
  const std::vector<double>& weight = table.column("weight_pa");
  const double porosity = table.column("porosity_at_rest").front();
  std::vector<double> drop = table.column("pressure_drop_pa");
  if (!(weight.front() > 0))
    throw_user_error({kLifting, fmt::format("{}, weight_pa", table.path()),
                      fmt::format("{:g}", weight.front()), "be > 0", ""});
  for (double& value : drop) value /= weight.front();
  const Lifting lifting = measure_lifting(table.column("superficial_velocity_z_m_per_s"), drop,
                                          options.window[0], options.window[1]);
  ResultRows rows;
  rows.add("least velocity of fluidisation, measured", "v_mf", lifting.velocity, "m/s",
           "packed line meets the weight",
           fmt::format("{} samples between {:g} and {:g} of it", lifting.packed.points, options.window[0],
                       options.window[1]));
  const double critical = critical_gradient(porosity, options.grain_density, options.fluid);
  add_formula(rows, "least velocity of fluidisation, Ergun",
              velocity_ergun(critical, options.diameter, porosity, options.fluid), lifting.velocity,
              "ergun1952", fmt::format("at the porosity at rest, {:.4f}", porosity));
  add_formula(rows, "least velocity of fluidisation, Wen and Yu",
              minimum_fluidisation_wen_yu(options.diameter, options.grain_density, options.fluid),
              lifting.velocity, "wenyu1966", "knows no porosity");
  rows.add("largest pressure drop over the weight", "", lifting.largest, "-", "", "");
  rows.add("pressure drop of the floating bed over the weight", "",
           lifting.floating > 0 ? std::optional(lifting.floating) : std::nullopt, "-", "mean beyond 1.3 v_mf",
           lifting.floating > 0 ? "" : "not reached");
  options.outputs.write(rows, kLifting);
  fmt::print("{}", rows.text());
}

}  // namespace

void add_lifting(CLI::App& app) {
  auto options = std::make_shared<LiftingOptions>();
  CLI::App* command = app.add_subcommand(
      kLifting, "Least velocity of fluidisation from a record of pressure drop over velocity (scene 06)");
  command
      ->add_option("FLOW", options->file,
                   "CSV file of `lbm monitor`: superficial_velocity, pressure_drop_pa, weight_pa, "
                   "porosity_at_rest")
      ->required();
  command->add_option("--diameter", options->diameter, "of the grains (Sauter's), m")->required();
  command
      ->add_option("--window", options->window,
                   "LOW HIGH: part of the weight over which the packed bed's line is fitted")
      ->expected(2)
      ->capture_default_str();
  options->add_to(*command);
  options->outputs.add_rows(*command);
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
