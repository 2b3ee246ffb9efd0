#include "verdict/shear_command.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/csv_file.h"
#include "files/output_options.h"
#include "files/record_table.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/shear_response.h"
#include "verdict/flow_record.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

constexpr const char* kShear = "shear";

struct ShearOptions {
  OutputOptions outputs;
  std::vector<std::string> files;
  std::string output;
  ShearSettings settings;
};

/// A number that chapter 5 reads off a curve, or a word.
struct Row {
  const char* quantity;
  std::string value;  ///< empty: not defined
};

/// Samples before the strain begins to grow: the servo still brings the stress to where the path begins.
void leave_out_the_wait(ShearSeries& series) {
  const std::vector<double>& strain = series.axial_strain;
  std::ptrdiff_t first = 0;
  while (first + 1 < std::ssize(strain) && strain[static_cast<std::size_t>(first)] == 0 &&
         strain[static_cast<std::size_t>(first) + 1] == 0)
    ++first;
  for (std::vector<double>* column : series.columns())
    if (!column->empty()) column->erase(column->begin(), column->begin() + first);
}

ShearSeries series_of(const std::string& path) {
  const NumberTable table(path, kShear);
  const auto if_there = [&](const char* name) {
    const std::vector<double>* column = table.find(name);
    return column != nullptr ? *column : std::vector<double>{};
  };
  ShearSeries series;
  series.axial_strain = table.column("axial_strain");
  series.mean_stress = table.column("mean_stress_pa");
  series.deviator = table.column("deviatoric_stress_pa");
  series.volumetric_strain = if_there("volumetric_strain");
  series.void_ratio = if_there("void_ratio");
  series.coordination = if_there("coordination_number");
  series.fine_coordination = if_there("coordination_fine_coarse");
  series.coarse_coordination = if_there("coordination_coarse_coarse");
  series.stress_reduction = if_there("alpha_pair_halves");
  series.sliding_share = if_there("sliding_share");
  if (series.axial_strain.back() < 0)  // extension: by the magnitudes of strain and deviator
    for (std::vector<double>* column : {&series.axial_strain, &series.deviator})
      for (double& value : *column) value = 0 - value;
  leave_out_the_wait(series);
  return series;
}

std::string path_of(const std::vector<FabricState>& fabrics) {
  std::string path;
  for (const FabricState& state : fabrics)
    path += fmt::format("{}{} from {:.3g}", path.empty() ? "" : "; ", to_string(state.fabric),
                        state.axial_strain);
  return path;
}

std::vector<Row> rows_of(const ShearResponse& response) {
  const auto& number = number_cell;
  std::vector<Row> rows{{"initial_void_ratio", number(response.initial_void_ratio)},
                        {"peak_deviatoric_stress_pa", number(response.peak_deviator)},
                        {"peak_stress_ratio", number(response.peak_ratio)},
                        {"axial_strain_at_peak", number(response.strain_at_peak)},
                        {"stress_ratio_at_end", number(response.end_ratio)},
                        {"axial_strain_at_end", number(response.end_strain)},
                        {"volumetric_strain_at_end", number(response.end_volumetric)},
                        {"axial_strain_of_constant_volume", number(response.strain_of_constant_volume)},
                        {"coordination_start", number(response.coordination_start)},
                        {"coordination_least", number(response.coordination_least)},
                        {"coordination_end", number(response.coordination_end)},
                        {"coordination_drop", number(response.coordination_drop)},
                        {"coarse_coordination_start", number(response.coarse_start)},
                        {"coarse_coordination_least", number(response.coarse_least)},
                        {"coarse_coordination_end", number(response.coarse_end)}};
  if (response.stages) {
    const StressReductionStages& stages = *response.stages;
    rows.insert(rows.end(), {{"alpha_start", number(stages.start)},
                             {"alpha_after_stage_1", number(stages.after_first)},
                             {"alpha_at_peak", number(stages.at_peak)},
                             {"alpha_at_end", number(stages.end)},
                             {"axial_strain_after_stage_1", number(stages.strain_first)},
                             {"stress_ratio_after_stage_1", number(stages.ratio_first)}});
  }
  if (!response.fabrics.empty()) {
    rows.push_back({"fabric_start", to_string(response.fabrics.front().fabric)});
    rows.push_back({"fabric_end", to_string(response.fabrics.back().fabric)});
    rows.push_back({"fabric_path", path_of(response.fabrics)});
  }
  rows.insert(rows.end(), {{"axial_strain_unstable", number(response.strain_unstable)},
                           {"sliding_most", number(response.sliding_most)},
                           {"axial_strain_of_most_sliding", number(response.strain_of_most_sliding)},
                           {"sliding_at_end", number(response.sliding_end)}});
  return rows;
}

void run(const ShearOptions& options) {
  options.outputs.require_new(kShear, options.files);
  const auto in_range = [](const char* option, double value, double most) {
    if (!(value > 0) || !(value < most))
      throw_user_error(
          {kShear, option, fmt::format("{:g}", value), fmt::format("be between 0 and {:g}", most), ""});
  };
  in_range("--window", options.settings.window, 1);
  in_range("--constant", options.settings.constant, 1);
  in_range("--level", options.settings.level, 1);
  std::optional<SafeFile> csv;
  if (!options.output.empty()) {
    csv.emplace(options.output, kShear);
    csv->write("series,quantity,value\n");
  }
  for (const std::string& file : options.files) {
    const std::string who = fmt::format("{}: {}", kShear, file);
    const std::vector<Row> rows = rows_of(shear_response(series_of(file), options.settings, who.c_str()));
    fmt::print("{}\n", file);
    for (const Row& row : rows) {
      fmt::print("  {:<34}{}\n", row.quantity, row.value.empty() ? "-" : row.value.substr(0, 60));
      if (csv) csv->write(fmt::format("{},{},{}\n", csv_text(file), row.quantity, csv_text(row.value)));
    }
  }
  if (csv) csv->commit();
}

}  // namespace

void add_shear(CLI::App& app) {
  auto options = std::make_shared<ShearOptions>();
  CLI::App* command =
      app.add_subcommand(kShear, "Peaks, critical volume, stages of alpha and fabrics of shear tests");
  command
      ->add_option("files", options->files,
                   "time series of shear tests (shear.csv of 02, triaxial.csv of 08)")
      ->required();
  command->add_option("--window", options->settings.window, "axial strain over which values are averaged")
      ->capture_default_str();
  command
      ->add_option("--constant", options->settings.constant,
                   "share of its start within which alpha is constant")
      ->capture_default_str();
  command
      ->add_option("--level", options->settings.level,
                   "share of its range within which the volume is constant")
      ->capture_default_str();
  options->outputs.add(*command, "--output", options->output, "CSV file: series, quantity, value");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
