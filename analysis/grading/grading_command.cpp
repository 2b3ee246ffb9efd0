#include "grading/grading_command.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "files/output_options.h"
#include "grading/criteria_table.h"
#include "grading/grading_table.h"

namespace suffuse::analysis {
namespace {

constexpr const char* kGrading = "grading";

struct GradingOptions {
  OutputOptions outputs;
  std::string file, output, curve, shape;
  std::vector<std::string> limits;
};

void run(const GradingOptions& options) {
  options.outputs.require_new(kGrading, {options.file});
  micromechanics::StabilityLimits limits;
  set_limits(options.limits, kGrading, limits);
  const micromechanics::Grading grading = grading_of_file(options.file, kGrading);
  const auto results = micromechanics::grading_criteria(grading, limits);
  std::optional<SafeFile> output, curve, shape;
  if (!options.output.empty()) write_criteria(output.emplace(options.output, "grading --output"), results);
  if (!options.curve.empty()) write_curve(curve.emplace(options.curve, "grading --curve"), grading);
  if (!options.shape.empty()) write_shape(shape.emplace(options.shape, "grading --shape"), grading, limits);
  for (auto* file : {&output, &curve, &shape})
    if (*file) (*file)->commit();
  fmt::print("{}\n{}", grading_text(grading), criteria_text(results));
}

}  // namespace

void add_grading(CLI::App& app) {
  auto options = std::make_shared<GradingOptions>();
  CLI::App* command =
      app.add_subcommand(kGrading, "Particle size distribution: sizes, Cu, Cc, gap, and the criteria on it");
  command
      ->add_option(
          "PSD", options->file,
          "CSV file with a column of sizes (diameter_mm, sieve_mm, sieve_no, ...) and one of amounts "
          "(percent_finer, retained_mass_g, mass_fraction, ...); or a dump of grains (its last snapshot)")
      ->required();
  options->outputs.add(*command, "--output", options->output, "CSV file with the criteria");
  options->outputs.add(*command, "--curve", options->curve, "CSV file with the cumulative curve");
  options->outputs.add(*command, "--shape", options->shape,
                       "CSV file with Kenney and Lau's shape curve (H, F)");
  command->add_option("--limit", options->limits,
                      "another limit, name=value, such as kenney_lau=1.3; may be repeated");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
