#include "verdict/verdict_command.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <system_error>

#include "contacts/read_options.h"
#include "files/output_options.h"
#include "grading/constriction_table.h"
#include "grading/criteria_table.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/coordination.h"
#include "verdict/flow_record.h"
#include "verdict/fluidisation_command.h"
#include "verdict/verdict_report.h"
#include "verdict/verdict_sentences.h"

namespace suffuse::analysis {
namespace {

namespace files = std::filesystem;
using micromechanics::Grading;

constexpr const char* kVerdict = "verdict";

/// Beyond this share of pores grains do not rest on each other: loose frictional packings have 0.45.
constexpr double kLoosestGrains = 0.6;

struct VerdictOptions {
  OutputOptions outputs;
  std::string grading, name, output, html, figures, flow;
  std::string fractions = "surface-area", pore = "inscribed";
  ReadOptions read;
  SplitOption split;
  std::vector<std::string> limits;
  micromechanics::ConstrictionOptions constriction;
  std::optional<double> porosity, relative_density, alpha;
  HydraulicInput hydraulic;
  bool no_figures = false;
};

/// A folder of its own under the system's one for such things, gone with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::random_device device;
    path_ = files::temp_directory_path() / fmt::format("suffuse-verdict-{:08x}{:08x}", device(), device());
    files::create_directory(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;  // nothing more can be done in a destructor
    files::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path() const { return path_.string(); }

 private:
  files::path path_;
};

void check(const VerdictOptions& options) {
  const auto share = [](const std::optional<double>& value, const char* option, bool open) {
    if (value && !(open ? *value > 0 && *value < 1 : *value >= 0 && *value <= 1))
      throw_user_error({kVerdict, option, fmt::format("{:g}", *value),
                        open ? "be between 0 and 1, ends excluded" : "be between 0 and 1",
                        "give a share, not per cent"});
  };
  if (options.grading.empty() && options.read.files.empty())
    throw_user_error({kVerdict, "PSD", "nothing", "be given, or --sample", "see --help"});
  share(options.porosity, "--porosity", true);
  share(options.relative_density, "--relative-density", false);
  share(options.constriction.split, "--cut", true);
  if (options.alpha && !(*options.alpha >= 0))
    throw_user_error({kVerdict, "--alpha", fmt::format("{:g}", *options.alpha), "be >= 0", ""});
  check_seepage_options(options.hydraulic, kVerdict);
  if (options.no_figures && !options.figures.empty())
    throw_user_error({kVerdict, "--figures", options.figures, "not stand beside --no-figures", ""});
  if (!options.figures.empty() && is_there(options.figures) && !is_folder(options.figures))
    throw_user_error({kVerdict, "--figures", options.figures, "be a folder", "this is a file"});
  if (!options.split.text.empty() && options.read.files.empty())
    throw_user_error({kVerdict, "--split", options.split.text, "have a sample", "add --sample"});
}

Grading grading_of_packing(const micromechanics::Packing& packing) {
  std::vector<double> diameters;
  for (const micromechanics::Grain& grain : packing.grains) diameters.push_back(2 * grain.radius);
  return Grading::from_grains(diameters);
}

/// Which grains of the sample are the fines, and why.
void choose_split(const VerdictOptions& options, const VerdictInput& input, const Snapshot& snapshot,
                  SampleFindings& sample) {
  std::string why;
  if (const std::optional<double> given = options.split.value(snapshot.packing, kVerdict)) {
    sample.split = *given;
    warning_of_split(sample.split, snapshot, kVerdict, "--split");  // without fines the report says so
    why = options.split.text == "gap" ? "in the widest gap of the sample's sizes" : "given";
  } else if (input.grading.gap()) {
    sample.split = std::sqrt(input.grading.gap()->finer_diameter * input.grading.gap()->coarser_diameter);
    why = "in the gap of the grading";
  } else {
    const auto split =
        input.constriction.split
            ? micromechanics::GradingSplit{*input.constriction.split, "given"}
            : micromechanics::thesis_split(input.grading, 0, input.constriction_limits, input.limits);
    sample.split = input.grading.diameter_at(split.finer);
    if (std::isnan(sample.split))
      throw_user_error({kVerdict, "--split", "not given", "be, as " + curve_end(input.grading),
                        "the split between fines and coarse grains lies below that"});
    why = fmt::format("{:.3g} % of the grading, {}", 100 * split.finer, split.rule);
  }
  sample.split_origin = fmt::format("{} snapshot. Fines are the grains below {:.4g} mm ({}).",
                                    options.flow.empty() ? "Last" : "First", 1e3 * sample.split, why);
  sample.at_rest = !options.flow.empty();
}

std::string names_of(const std::vector<std::string>& paths) {
  std::string text;
  for (const std::string& path : paths)
    text += fmt::format("{}`{}`", text.empty() ? "" : ", ", files::path(path).filename().string());
  return text;
}

/// The last snapshot; with a run of upward flow the first, in which the bed is at rest: its last one is
/// lifted.
std::optional<Snapshot> judged_snapshot(VerdictOptions& options) {
  if (options.read.files.empty()) return std::nullopt;
  const std::unique_ptr<SnapshotSeries> series = options.read.open();
  Snapshot snapshot;
  bool found = false;
  while (series->next(snapshot)) {
    found = true;
    if (!options.flow.empty()) break;
  }
  if (!found)
    throw_user_error(
        {kVerdict, "--sample", options.read.files.front(), "hold a snapshot of grains and contacts", ""});
  if (const std::string notes = series->notes(); !notes.empty())
    fmt::print(stderr, "suffuse-analyse: note: {}\n", notes);  // the report may go to the screen
  return snapshot;
}

/// As given; else of the bed at rest where a run is given, whose box holds more than the bed; else of the
/// sample.
void find_porosity(const VerdictOptions& options, const std::optional<Snapshot>& snapshot,
                   VerdictInput& input) {
  input.porosity = options.porosity;
  input.porosity_from = "as given";
  if (input.porosity) return;
  if (!options.flow.empty()) {
    input.porosity = flow_record(NumberTable(options.flow, kVerdict), kVerdict, std::nullopt).porosity;
    input.porosity_from = "of the bed at rest in " + names_of({options.flow});
  } else if (snapshot) {
    double solids = 0;
    for (const micromechanics::Grain& grain : snapshot->packing.grains)
      solids += micromechanics::sphere_volume(grain.radius);
    input.porosity = 1 - solids / snapshot->packing.volume;
    input.porosity_from = "of the sample's grains in its volume";
    if (*input.porosity > kLoosestGrains)
      input.porosity_from +=
          ", more than grains at rest leave open: give `--bed`, `--volume` or `--porosity` if water stands "
          "above them";
  }
}

VerdictInput input_of(const VerdictOptions& options, const std::optional<Snapshot>& snapshot) {
  VerdictInput input{options.name,
                     "",
                     options.grading.empty() ? grading_of_packing(snapshot->packing)
                                             : grading_of_file(options.grading, kVerdict),
                     {},
                     {},
                     options.constriction,
                     options.relative_density,
                     {},
                     {},
                     options.hydraulic,
                     options.alpha,
                     options.flow};
  set_limits(options.limits, kVerdict, input.limits, &input.constriction_limits);
  const std::string& file = options.grading.empty() ? options.read.files.front() : options.grading;
  if (input.name.empty()) input.name = files::path(file).stem().string();
  input.grading_from = options.grading.empty() ? "the grains of the sample" : names_of({options.grading});
  find_porosity(options, snapshot, input);
  if (input.porosity) {
    HydraulicInput checked = input.hydraulic;
    checked.porosity = *input.porosity;
    check_hydraulic(checked, kVerdict);
  }
  return input;
}

std::optional<SampleFindings> measure_sample(const VerdictOptions& options, const VerdictInput& input,
                                             const std::optional<Snapshot>& snapshot) {
  if (!snapshot) return std::nullopt;
  SampleFindings sample;
  choose_split(options, input, *snapshot, sample);
  MeasureSettings settings;
  settings.split = sample.split;
  ContactMeasurer measurer(settings);
  sample.record = measurer.measure(*snapshot);
  sample.forces = measurer.forces();
  sample.bins = settings.force_bins;
  sample.step = snapshot->step;
  sample.files = names_of(options.read.files);
  sample.friction = options.read.settings.friction;
  return sample;
}

/// All figures, in a folder that is not yet the user's.
std::vector<VerdictFigure> draw(const VerdictOptions& options, const VerdictInput& input,
                                const VerdictFindings& findings, const std::optional<Snapshot>& snapshot,
                                const std::string& folder) {
  if (options.no_figures || (options.html.empty() && options.figures.empty())) return {};
  try {
    return draw_verdict_figures(input, findings, snapshot ? &snapshot->packing : nullptr, folder,
                                !options.figures.empty());
  } catch (const UserError& problem) {
    throw UserError(std::string(problem.what()) + "; or do without: --no-figures");
  }
}

void keep_figures(const std::string& from, const std::string& to) {
  std::error_code problem;
  files::create_directories(to, problem);
  if (!problem)
    files::copy(from, to, files::copy_options::recursive | files::copy_options::overwrite_existing, problem);
  if (problem)
    throw_user_error({kVerdict, "--figures", to, "be a folder that can be written to", problem.message()});
}

void run(VerdictOptions& options) {
  check(options);
  std::vector<std::string> inputs = options.read.files;
  inputs.insert(inputs.end(), {options.grading, options.flow});
  options.outputs.require_new(kVerdict, inputs);
  options.constriction.fractions = fraction_names().at(options.fractions);
  options.constriction.pore = pore_names().at(options.pore);
  const std::optional<Snapshot> snapshot = judged_snapshot(options);
  const VerdictInput input = input_of(options, snapshot);
  VerdictFindings findings = find_verdicts(input, measure_sample(options, input, snapshot));
  if (!options.flow.empty())
    findings.flow = fluidisation_rows(options.flow, options.grading, options.hydraulic.grain_density,
                                      options.hydraulic.fluid);
  // Files are opened before the figures are drawn, so that a name that cannot be written is told at once.
  std::optional<SafeFile> markdown, html;
  if (!options.output.empty()) markdown.emplace(options.output, "verdict --output");
  if (!options.html.empty()) html.emplace(options.html, "verdict --html");
  const TemporaryFolder folder;
  const std::vector<VerdictFigure> figures = draw(options, input, findings, snapshot, folder.path());
  std::string links;
  if (!options.figures.empty()) {
    keep_figures(folder.path(), options.figures);
    const files::path page =
        options.output.empty() ? files::path(".") : files::absolute(options.output).parent_path();
    links = files::proximate(options.figures, page).generic_string();
  }
  const ReportDocument report = verdict_report(input, findings, figures, links);
  if (markdown) markdown->write(report.markdown());
  if (html) html->write(report.html());
  for (auto* file : {&markdown, &html})
    if (*file) (*file)->commit();
  if (markdown || html)
    fmt::print("{}: {}\n", input.name, headline(input, findings));
  else
    fmt::print("{}", report.markdown());
}

}  // namespace

void add_verdict(CLI::App& app) {
  auto options = std::make_shared<VerdictOptions>();
  CLI::App* command = app.add_subcommand(
      kVerdict, "One report on a soil: grading, all criteria side by side, a sample's contacts, gradients");
  command->add_option("PSD", options->grading,
                      "grading: CSV file or dump of grains, as in `grading`; without it that of the sample");
  options->read.add_to(*command, "--sample");
  options->split.add_to(*command);
  command->add_option("--flow", options->flow,
                      "record of an upward-flow run (`lbm monitor`), as in `fluidisation`");
  command->add_option("--name", options->name, "of the soil; the file's if not given");
  command->add_option("--relative-density", options->relative_density, "0 (loosest) to 1 (densest)");
  command->add_option("--porosity", options->porosity, "of the soil; the sample's if not given");
  command->add_option(
      "--cut", options->constriction.split,
      "share finer at which the grading is cut into filter and base; the thesis's rule if not given");
  std::vector<std::string> fractions, pores;
  for (const auto& [name, value] : fraction_names()) fractions.push_back(name);
  for (const auto& [name, value] : pore_names()) pores.push_back(name);
  command->add_option("--fractions", options->fractions, "probability of a class by")
      ->check(CLI::IsMember(fractions))
      ->capture_default_str();
  command->add_option("--loose-pore", options->pore, "hole between four grains")
      ->check(CLI::IsMember(pores))
      ->capture_default_str();
  command->add_option("--limit", options->limits,
                      "another limit, name=value, as in grading and constriction");
  command->add_option("--alpha", options->alpha,
                      "stress reduction factor of the fines, known from elsewhere");
  options->hydraulic.add_to(*command);
  options->outputs.add(*command, "--output", options->output,
                       "the report as Markdown; without --html too: on the screen");
  options->outputs.add(*command, "--html", options->html,
                       "the report as one HTML page with its figures in it");
  options->outputs.add(*command, "--figures", options->figures,
                       "folder for the figures (SVG, PNG) and their CSV files");
  command->add_flag("--no-figures", options->no_figures, "no figures: Python with matplotlib is not needed");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
