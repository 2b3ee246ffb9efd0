#include "grading/hydraulic_table.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/common/error.h"

namespace suffuse::analysis {

namespace {

void must(bool fine, const std::string& who, const char* option, double value, const char* rule) {
  if (!fine) throw_user_error({who, option, fmt::format("{:g}", value), rule, ""});
}

}  // namespace

void SeepageOptions::add_to(CLI::App& command) {
  command.add_option("--grain-density", grain_density, "kg/m3")->capture_default_str();
  command.add_option("--fluid-density", fluid.density, "kg/m3")->capture_default_str();
  command.add_option("--viscosity", fluid.kinematic_viscosity, "kinematic, m2/s")->capture_default_str();
  command.add_option("--gravity", fluid.gravity, "m/s2")->capture_default_str();
}

void SeepageOptions::check(const std::string& who) const {
  must(fluid.density > 0, who, "--fluid-density", fluid.density, "be > 0");
  must(grain_density > fluid.density, who, "--grain-density", grain_density, "be above the fluid's");
  must(fluid.kinematic_viscosity > 0, who, "--viscosity", fluid.kinematic_viscosity, "be > 0");
  must(fluid.gravity > 0, who, "--gravity", fluid.gravity, "be > 0");
}

void HydraulicInput::add_to(CLI::App& command) {
  command.add_option("--top-stress", top_stress, "effective stress on the layer, Pa (with --thickness)");
  command.add_option("--thickness", thickness, "of the layer, m");
  SeepageOptions::add_to(command);
}

void check_seepage_options(const HydraulicInput& options, const std::string& who) {
  options.check(who);
  for (const HydraulicInput::Alpha& alpha : options.alphas)
    must(alpha.value >= 0, who, "--alpha", alpha.value, "be >= 0");
  if (options.top_stress) must(*options.top_stress >= 0, who, "--top-stress", *options.top_stress, "be >= 0");
  if (options.thickness) must(*options.thickness > 0, who, "--thickness", *options.thickness, "be > 0");
  if (options.top_stress.has_value() != options.thickness.has_value())
    throw_user_error({who, "--top-stress, --thickness", "one alone", "be given together", ""});
}

void check_hydraulic(const HydraulicInput& options, const std::string& who) {
  if (!(options.porosity > 0 && options.porosity < 1))
    throw_user_error({who, "--porosity", fmt::format("{:g}", options.porosity), "be between 0 and 1", ""});
  check_seepage_options(options, who);
}

std::vector<HydraulicRow> hydraulic_rows(const HydraulicInput& options,
                                         const micromechanics::Grading& grading) {
  using namespace micromechanics;
  const GradingIndices sizes = grading_indices(grading);
  const double n = options.porosity, terzaghi = critical_gradient(n, options.grain_density, options.fluid);
  std::vector<HydraulicRow> rows{{"critical gradient, Terzaghi", "i_cr", "-", "terzaghi1943", "", terzaghi}};
  const auto by = [](const HydraulicInput::Alpha& alpha) {
    return fmt::format("alpha = {:.4g}{}", alpha.value,
                       alpha.origin.empty() ? std::string() : " (" + alpha.origin + ")");
  };
  for (const HydraulicInput::Alpha& alpha : options.alphas)
    rows.push_back({"critical gradient of the fines, Skempton and Brogan", "i_cr", "-", "skemptonbrogan1994",
                    by(alpha) + (alpha.value > 1 ? ", taken as 1" : ""),
                    critical_gradient_of_fines(n, options.grain_density, alpha.value, options.fluid)});
  std::vector<HydraulicInput::Alpha> under_stress = options.alphas;
  if (under_stress.empty()) under_stress.push_back({1, ""});
  if (options.top_stress)
    for (const HydraulicInput::Alpha& alpha : under_stress)
      rows.push_back(
          {"critical gradient under stress, Li and Fannin", "i_cr", "-", "lifannin2012",
           by(alpha) + fmt::format(", {:g} Pa on {:g} m", *options.top_stress, *options.thickness),
           critical_gradient_by_top_stress(n, options.grain_density, alpha.value,
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
  for (HydraulicRow& row : rows)
    if (std::isnan(row.value)) row.note = "not applicable: " + curve_end(grading);
  return rows;
}

}  // namespace suffuse::analysis
