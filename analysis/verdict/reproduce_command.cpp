#include "verdict/reproduce_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "contacts/contact_measures.h"
#include "files/output_options.h"
#include "files/record_table.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/constriction_criteria.h"
#include "suffuse/micromechanics/microscale_verdicts.h"
#include "verdict/sample_folder.h"
#include "verdict/thesis_tables.h"

namespace suffuse::analysis {
namespace {

using micromechanics::Grading;

enum class Table { table_4_1, table_5_1 };

struct ReproduceOptions {
  OutputOptions outputs;
  std::vector<std::string> folders{"."};
  std::string output;
};

/// A number of a sample beside the thesis's.
struct Compared {
  const char* name;
  std::optional<double> measured, thesis;
};

/// A sample that has been simulated, and its row.
struct Comparison {
  const ThesisRow* row = nullptr;
  SampleFolder sample;
  std::vector<Compared> quantities;
  std::string verdict, thesis_verdict;
};

const char* verdict_of(std::optional<double> z, std::optional<double> alpha) {
  using namespace micromechanics;
  if (!z || !alpha) return "unknown";
  return to_string(microscale_verdict(*z, *alpha, BoundaryWording::either));
}

/// The last snapshot of a sample.
Snapshot final_state(const SampleFolder& sample, const std::string& who) {
  ReadSettings settings;
  settings.who = who;
  settings.friction = sample.friction;
  const std::unique_ptr<SnapshotSeries> series = open_series({sample.grains, sample.contacts}, settings);
  Snapshot snapshot;
  while (series->next(snapshot)) {
  }
  return snapshot;
}

/// The criteria on the grains as they are in the sample.
struct GradingRatios {
  std::optional<double> kezdi, kenney_lau, constriction;
  std::optional<double> constriction_loose_cut;  ///< dense, cut where loose soils are, if that differs
  std::optional<double> coordination, stress_reduction;  ///< Z and alpha that eqs 4.7, 4.8 give for them
};

Grading grading_of(const Snapshot& snapshot) {
  std::vector<double> diameters;
  for (const micromechanics::Grain& grain : snapshot.packing.grains) diameters.push_back(2 * grain.radius);
  return Grading::from_grains(diameters);
}

/// The thesis's limits; whole grains put a nominal 25 % of fines a little beside it (11b: 0.2497).
micromechanics::ConstrictionLimits limits_for(const Grading& grading) {
  constexpr double of_whole_grains = 0.005;
  micromechanics::ConstrictionLimits limits;
  if (grading.gap() && grading.gap()->finer > limits.fines_split - of_whole_grains)
    limits.fines_split = std::min(limits.fines_split, grading.gap()->finer);
  return limits;
}

GradingRatios ratios_of(const Grading& grading, double relative_density) {
  GradingRatios ratios;
  constexpr double from_finer =
      0.05;  // so read, 7a's printed 4.720 comes out, too (docs/analysis/criteria.md)
  ratios.kezdi = micromechanics::maximum_split_ratio(grading, from_finer).ratio;
  ratios.kenney_lau = micromechanics::minimum_shape_ratio(grading).ratio;
  micromechanics::ConstrictionOptions options;
  options.relative_density = relative_density;
  micromechanics::ConstrictionLimits limits = limits_for(grading);
  try {
    const micromechanics::ConstrictionAnalysis analysis =
        micromechanics::analyse_constrictions(grading, options, limits);
    limits.dense_split = limits.fines_split;
    if (micromechanics::thesis_split(grading, relative_density, limits).finer != analysis.split.finer)
      ratios.constriction_loose_cut = micromechanics::analyse_constrictions(grading, options, limits).ratio();
    ratios.constriction = analysis.ratio();
    ratios.coordination = analysis.coordination;
    ratios.stress_reduction = analysis.stress_reduction;
  } catch (const UserError&) {
    // No fraction to split off, as in grains of one size: the ratio does not apply and stays empty.
  }
  return ratios;
}

/// Table 4.1's alpha of soils with 25 % of fines or more is not that of all fines: it is that of the finest
/// 20 % (dense) or 25 % (loose, medium), at which the thesis splits these soils for the constriction ratio
/// (section 4.3); Table 5.1 prints that of all fines of the same samples. None where the split is the gap.
std::optional<double> alpha_of_finest(const Snapshot& snapshot, const Grading& grading,
                                      double relative_density, const std::string& who) {
  if (!grading.gap()) return std::nullopt;
  const double finer = micromechanics::thesis_split(grading, relative_density, limits_for(grading)).finer;
  if (finer == grading.gap()->finer) return std::nullopt;
  MeasureSettings settings;
  settings.split = split_at_finer(snapshot.packing, finer, who);
  return value_of(ContactMeasurer(settings).measure(snapshot), "alpha_pair_halves");
}

std::optional<double> predicted(double (*equation)(double), std::optional<double> ratio) {
  return ratio ? std::optional<double>(equation(*ratio)) : std::nullopt;
}

Comparison compare(const SampleFolder& sample, const ThesisRow& row, Table table, const std::string& who) {
  const Snapshot snapshot = final_state(sample, who);
  MeasureSettings settings;
  settings.split =
      sample.split ? sample.split : std::optional<double>(split_in_the_gap(snapshot.packing, who));
  if (const std::string warning =
          warning_of_split(*settings.split, snapshot, who + ": " + sample.folder, "split_m");
      !warning.empty())
    fmt::print("{}: {}\n", sample.folder, warning);
  const Record record = ContactMeasurer(settings).measure(snapshot);
  const auto measured = [&](const char* name) { return value_of(record, name); };
  Comparison result{&row, sample, {}, {}, {}};
  std::optional<double> alpha_finest;
  if (table == Table::table_4_1) {
    const Grading grading = grading_of(snapshot);
    const GradingRatios ratios = ratios_of(grading, row.relative_density);
    alpha_finest = alpha_of_finest(snapshot, grading, row.relative_density, who);
    result.quantities = {{"kezdi_ratio", ratios.kezdi, row.kezdi},
                         {"constriction_ratio", ratios.constriction, row.constriction},
                         {"kenney_lau_ratio", ratios.kenney_lau, row.kenney_lau},
                         {"coordination_eq_4_7", ratios.coordination,
                          predicted(micromechanics::predicted_coordination, row.constriction)},
                         {"alpha_eq_4_8", ratios.stress_reduction,
                          predicted(micromechanics::predicted_stress_reduction, row.constriction)},
                         {"porosity", measured("porosity"), row.porosity}};
    if (ratios.constriction_loose_cut)  // the table's own rows are those of this cut, but for 11b's
      result.quantities.insert(result.quantities.begin() + 2,
                               {"constriction_ratio_25", ratios.constriction_loose_cut, row.constriction});
  } else {
    result.quantities = {{"void_ratio", measured("void_ratio"), row.void_ratio}};
  }
  result.quantities.push_back({"grains", measured("grains"), row.grains});
  result.quantities.push_back({"coordination_number", measured("coordination_number"), row.coordination});
  result.quantities.push_back(
      {"alpha_pair_halves", measured("alpha_pair_halves"), alpha_finest ? std::nullopt : row.alpha});
  if (alpha_finest) result.quantities.push_back({"alpha_finest_fraction", alpha_finest, row.alpha});
  result.quantities.push_back({"alpha_contact_point", measured("alpha_contact_point"), std::nullopt});
  result.quantities.push_back({"mean_stress_pa", measured("mean_stress_pa"), 200e3});
  result.verdict = verdict_of(measured("coordination_number"), measured("alpha_pair_halves"));
  result.thesis_verdict = verdict_of(row.coordination, row.alpha);
  return result;
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.5g}", *value) : "-";
}

std::optional<double> difference(const Compared& quantity) {
  if (!quantity.measured || !quantity.thesis || *quantity.thesis == 0) return std::nullopt;
  return *quantity.measured / *quantity.thesis - 1;
}

void print(const Comparison& comparison) {
  const ThesisRow& row = *comparison.row;
  fmt::print("{} {}: {}", row.sample, row.state, comparison.sample.folder);
  if (comparison.sample.youngs_modulus)
    fmt::print(", E = {:.3g} GPa", *comparison.sample.youngs_modulus / 1e9);
  fmt::print("\n  {:<22}{:>12}{:>12}{:>13}\n", "", "measured", "thesis", "difference");
  for (const Compared& quantity : comparison.quantities) {
    const std::optional<double> relative = difference(quantity);
    fmt::print("  {:<22}{:>12}{:>12}{:>13}\n", quantity.name, number(quantity.measured),
               number(quantity.thesis), relative ? fmt::format("{:+.1f} %", 100 * *relative) : "");
  }
  fmt::print("  {:<22}{:>12}{:>12}   (unstable: Z <= 1 or alpha <= 0.5{})\n", "verdict", comparison.verdict,
             comparison.thesis_verdict, row.experiment.empty() ? "" : "; in experiments " + row.experiment);
  if (!row.note.empty()) fmt::print("  the thesis's row: {}\n", row.note);
}

bool same_name(const Compared& one, const Compared& other) {
  return std::string_view(one.name) == other.name;
}

/// Of several samples of one row: their mean and how far they scatter.
void print_mean(const std::vector<Comparison>& of_row) {
  fmt::print("{} {}: mean of {} samples and standard deviation\n", of_row[0].row->sample,
             of_row[0].row->state, of_row.size());
  // Some quantities are there for some samples only, by their fines.
  std::vector<const Compared*> of_any;
  for (const Comparison& comparison : of_row)
    for (const Compared& quantity : comparison.quantities)
      if (std::ranges::none_of(of_any, [&](const Compared* q) { return same_name(*q, quantity); }))
        of_any.push_back(&quantity);
  for (const Compared* quantity : of_any) {
    double sum = 0, squares = 0, n = 0;
    for (const Comparison& comparison : of_row)
      for (const Compared& one : comparison.quantities) {
        if (!one.measured || !same_name(one, *quantity)) continue;
        sum += *one.measured;
        squares += *one.measured * *one.measured;
        n += 1;
      }
    if (n < 2) continue;
    const double mean = sum / n, deviation = std::sqrt(std::max(0.0, (squares - n * mean * mean) / (n - 1)));
    fmt::print("  {:<22}{:>12}{:>12}   +- {:.2g}{}\n", quantity->name, number(mean), number(quantity->thesis),
               deviation, n < static_cast<double>(of_row.size()) ? fmt::format("   ({:g} samples)", n) : "");
  }
}

void write_csv(const std::string& path, const std::vector<Comparison>& comparisons, const std::string& who) {
  SafeFile file(path, who);
  file.write("sample,state,folder,youngs_modulus_pa,quantity,measured,thesis,relative_difference\n");
  for (const Comparison& comparison : comparisons)
    for (const Compared& quantity : comparison.quantities)
      file.write(fmt::format("{},{},\"{}\",{},{},{},{},{}\n", comparison.row->sample, comparison.row->state,
                             comparison.sample.folder, number_cell(comparison.sample.youngs_modulus),
                             quantity.name, number_cell(quantity.measured), number_cell(quantity.thesis),
                             number_cell(difference(quantity))));
  file.commit();
}

const ThesisRow* row_of(const std::vector<ThesisRow>& rows, const SampleFolder& sample,
                        const std::string& name) {
  for (const ThesisRow& row : rows)
    if (row.sample == name && row.state == sample.state) return &row;
  return nullptr;
}

void run(const ReproduceOptions& options, Table table) {
  const std::string who = table == Table::table_4_1 ? "reproduce table-4-1" : "reproduce table-5-1";
  const std::vector<ThesisRow>& rows = table == Table::table_4_1 ? thesis_table_4_1() : thesis_table_5_1();
  const std::vector<std::string> folders = find_sample_folders(options.folders, who);
  std::vector<std::string> inputs;
  for (const std::string& folder : folders)
    for (const char* name : {"/sample.toml", "/*.dump*"}) inputs.push_back(folder + name);
  options.outputs.require_new(who, inputs);
  std::vector<Comparison> comparisons;
  for (const std::string& folder : folders) {
    const SampleFolder sample = read_sample_folder(folder, who);
    const std::string& name = table == Table::table_4_1 ? sample.table_4_1 : sample.table_5_1;
    if (name.empty()) continue;
    const ThesisRow* row = row_of(rows, sample, name);
    if (row == nullptr) {
      const bool known =
          std::any_of(rows.begin(), rows.end(), [&](const ThesisRow& r) { return r.sample == name; });
      if (known) continue;  // Table 5.1 has dense states only
      throw_user_error({who + ": " + folder + "/sample.toml", "sample", name, "be a sample of the table",
                        "see analysis/data"});
    }
    comparisons.push_back(compare(sample, *row, table, who));
  }
  if (comparisons.empty())
    throw UserError(
        fmt::format("{}: no folder has a sample.toml of this table; a sample by "
                    "input_scripts/01_isotropic_compression leaves one",
                    who));
  std::size_t rows_run = 0, alike = 0;
  for (const ThesisRow& row : rows) {  // in the order of the table
    std::vector<Comparison> of_row;
    std::copy_if(comparisons.begin(), comparisons.end(), std::back_inserter(of_row),
                 [&](const Comparison& comparison) { return comparison.row == &row; });
    for (const Comparison& comparison : of_row) {
      print(comparison);
      alike += comparison.verdict == comparison.thesis_verdict ? 1 : 0;
    }
    if (of_row.size() > 1) print_mean(of_row);
    rows_run += of_row.empty() ? 0 : 1;
  }
  fmt::print("{} of {} rows have been run; {} of {} samples have the thesis's verdict\n", rows_run,
             rows.size(), alike, comparisons.size());
  if (!options.output.empty()) write_csv(options.output, comparisons, who);
}

void add_table(CLI::App& parent, const char* name, const char* what, Table table) {
  auto options = std::make_shared<ReproduceOptions>();
  CLI::App* command = parent.add_subcommand(name, what);
  command
      ->add_option("folders", options->folders,
                   "folders of samples, or folders above them: all with a file sample.toml are taken")
      ->capture_default_str();
  options->outputs.add(*command, "--output", options->output, "CSV file, a row a number");
  command->callback([options, table] { run(*options, table); });
}

}  // namespace

void add_reproduce(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("reproduce", "Samples that have been simulated against the thesis's tables");
  command->require_subcommand(1);
  add_table(*command, "table-4-1", "Table 4.1: grading criteria, porosity, Z and alpha at 200 kPa",
            Table::table_4_1);
  add_table(*command, "table-5-1", "Table 5.1: void ratio, Z and alpha before shearing", Table::table_5_1);
}

}  // namespace suffuse::analysis
