#include "commands/hydraulic_command.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "commands/criteria_table.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/seepage.h"

namespace suffuse::analysis {
namespace {

constexpr const char* kWho = "hydraulic";

struct Options {
  std::string file, output;
  double porosity = 0, grain_density = 2650;
  micromechanics::SeepageFluid fluid;
  std::optional<double> stress_reduction, top_stress, thickness;
};

struct Row {
  std::string quantity, symbol, unit, source, note;
  double value = 0;
};

void check(const Options& options) {
  const auto must = [](bool fine, const char* option, double value, const char* rule) {
    if (!fine) throw_user_error({kWho, option, fmt::format("{:g}", value), rule, ""});
  };
  must(options.porosity > 0 && options.porosity < 1, "--porosity", options.porosity, "be between 0 and 1");
  must(options.fluid.density > 0, "--fluid-density", options.fluid.density, "be > 0");
  must(options.grain_density > options.fluid.density, "--grain-density", options.grain_density,
       "be above the fluid's");
  must(options.fluid.kinematic_viscosity > 0, "--viscosity", options.fluid.kinematic_viscosity, "be > 0");
  must(options.fluid.gravity > 0, "--gravity", options.fluid.gravity, "be > 0");
  if (options.stress_reduction)
    must(*options.stress_reduction >= 0, "--alpha", *options.stress_reduction, "be >= 0");
  if (options.top_stress) must(*options.top_stress >= 0, "--top-stress", *options.top_stress, "be >= 0");
  if (options.thickness) must(*options.thickness > 0, "--thickness", *options.thickness, "be > 0");
  if (options.top_stress.has_value() != options.thickness.has_value())
    throw_user_error({kWho, "--top-stress, --thickness", "one alone", "be given together", ""});
}

std::vector<Row> measure(const Options& options, const micromechanics::Grading& grading) {
  using namespace micromechanics;
  const GradingIndices sizes = grading_indices(grading);
  const double n = options.porosity, terzaghi = critical_gradient(n, options.grain_density, options.fluid);
  std::vector<Row> rows{{"critical gradient, Terzaghi", "i_cr", "-", "terzaghi1943", "", terzaghi}};
  const double alpha = options.stress_reduction.value_or(1);
  if (options.stress_reduction)
    rows.push_back({"critical gradient of the fines, Skempton and Brogan", "i_cr", "-", "skemptonbrogan1994",
                    fmt::format("alpha = {:g}{}", alpha, alpha > 1 ? ", taken as 1" : ""),
                    critical_gradient_of_fines(n, options.grain_density, alpha, options.fluid)});
  if (options.top_stress)
    rows.push_back(
        {"critical gradient under stress, Li and Fannin", "i_cr", "-", "lifannin2012",
         fmt::format("alpha = {:g}, {:g} Pa on {:g} m", alpha, *options.top_stress, *options.thickness),
         critical_gradient_by_top_stress(n, options.grain_density, alpha,
                                         {*options.top_stress, *options.thickness}, options.fluid)});
  rows.push_back({"conductivity, Hazen", "K", "m/s", "hazen1892",
                  sizes.uniformity < 5 ? "" : fmt::format("made for Cu < 5, here {:.3g}", sizes.uniformity),
                  conductivity_hazen(sizes.d10)});
  rows.push_back({"conductivity, Carman and Kozeny", "K", "m/s", "carman1939",
                  fmt::format("Sauter's size {:.4g} mm", 1e3 * sizes.sauter),
                  conductivity_carman_kozeny(sizes.sauter, n, options.fluid)});
  rows.push_back({"conductivity, Chapuis", "K", "m/s", "chapuis2004", "water at 20 degrees",
                  conductivity_chapuis(sizes.d10, n)});
  const double velocity = velocity_ergun(terzaghi, sizes.sauter, n, options.fluid);
  rows.push_back(
      {"velocity at Terzaghi's gradient, Ergun", "U", "m/s", "ergun1952",
       fmt::format("Re = U d/nu = {:.3g}", velocity * sizes.sauter / options.fluid.kinematic_viscosity),
       velocity});
  return rows;
}

void run(const Options& options) {
  check(options);
  const std::vector<Row> rows = measure(options, grading_of_file(options.file, kWho));
  if (!options.output.empty()) {
    SafeFile file(options.output, "hydraulic --output");
    file.write("quantity,symbol,value,unit,source,note\n");
    for (const Row& row : rows)
      file.write(fmt::format("\"{}\",{},{},{},{},\"{}\"\n", row.quantity, row.symbol, row.value, row.unit,
                             row.source, row.note));
    file.commit();
  }
  for (const Row& row : rows)
    fmt::print("{:<52} {:<4} = {:>10.4g} {:<3}  {:<18}  {}\n", row.quantity, row.symbol, row.value, row.unit,
               row.source, row.note);
}

}  // namespace

void add_hydraulic(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand(kWho, "Critical gradients and conductivities of a soil, without a run");
  command->add_option("PSD", options->file, "grading: CSV file or dump of grains, as in `grading`")
      ->required();
  command->add_option("--porosity", options->porosity, "of the soil")->required();
  command->add_option("--alpha", options->stress_reduction,
                      "stress reduction factor of the fines, measured or by eq 4.8");
  command->add_option("--top-stress", options->top_stress,
                      "effective stress on the layer, Pa (with --thickness)");
  command->add_option("--thickness", options->thickness, "of the layer, m");
  command->add_option("--grain-density", options->grain_density, "kg/m3")->capture_default_str();
  command->add_option("--fluid-density", options->fluid.density, "kg/m3")->capture_default_str();
  command->add_option("--viscosity", options->fluid.kinematic_viscosity, "kinematic, m2/s")
      ->capture_default_str();
  command->add_option("--gravity", options->fluid.gravity, "m/s2")->capture_default_str();
  command->add_option("--output", options->output, "CSV file with the same");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
