#include "grading/hydraulic_command.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "files/csv_file.h"
#include "files/output_options.h"
#include "grading/criteria_table.h"
#include "grading/hydraulic_table.h"

namespace suffuse::analysis {
namespace {

constexpr const char* kHydraulic = "hydraulic";

struct HydraulicOptions {
  OutputOptions outputs;
  std::string file, output;
  HydraulicInput input;
  std::optional<double> alpha;
};

void run(HydraulicOptions& options) {
  options.outputs.require_new(kHydraulic, {options.file});
  if (options.alpha) options.input.alphas = {{*options.alpha, ""}};
  check_hydraulic(options.input, kHydraulic);
  const std::vector<HydraulicRow> rows =
      hydraulic_rows(options.input, grading_of_file(options.file, kHydraulic));
  if (!options.output.empty()) {
    SafeFile file(options.output, "hydraulic --output");
    file.write("quantity,symbol,value,unit,source,note\n");
    for (const HydraulicRow& row : rows)
      file.write(fmt::format("{},{},{},{},{},{}\n", csv_text(row.quantity), row.symbol,
                             std::isnan(row.value) ? std::string() : fmt::format("{}", row.value), row.unit,
                             row.source, csv_text(row.note)));
    file.commit();
  }
  for (const HydraulicRow& row : rows)
    fmt::print("{:<52} {:<4} = {:>10} {:<3}  {:<18}  {}\n", row.quantity, row.symbol,
               std::isnan(row.value) ? std::string("-") : fmt::format("{:.4g}", row.value), row.unit,
               row.source, row.note);
}

}  // namespace

void add_hydraulic(CLI::App& app) {
  auto options = std::make_shared<HydraulicOptions>();
  CLI::App* command =
      app.add_subcommand(kHydraulic, "Critical gradients and conductivities of a soil, without a run");
  command->add_option("PSD", options->file, "grading: CSV file or dump of grains, as in `grading`")
      ->required();
  command->add_option("--porosity", options->input.porosity, "of the soil")->required();
  command->add_option("--alpha", options->alpha,
                      "stress reduction factor of the fines, measured or by eq 4.8");
  options->input.add_to(*command);
  options->outputs.add(*command, "--output", options->output, "CSV file with the same");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
