#include "grading/sample_command.h"
#include "files/output_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "files/number_parser.h"
#include "grading/criteria_table.h"
#include "grading/grading_names.h"
#include "grading/sample_script.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/micromechanics/constriction_criteria.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

constexpr const char* kSample = "sample";

struct SampleOptions {
  std::string grading, output = "sample", name, grains;
  std::optional<double> smallest, solid_fraction, split;
  double coarse = 500, scale = 1, affordable = 150000;
  std::size_t classes = 20;
  std::uint64_t seed = 32452867;
  double density = 2650;
  std::optional<double> box_edge, box_height;
  bool quiet = false, variables_only = false;
  OutputOptions outputs;
};

/// `--grains`: a number, or `thesis` and none, as many as --coarse takes but for the thesis's samples.
double grains_wanted(const SampleOptions& options, const std::optional<NamedGrading>& named,
                     double for_coarse) {
  if (options.grains.empty()) return std::ceil(for_coarse);
  if (options.grains == "thesis") return named ? named->thesis_grains : std::ceil(for_coarse);
  double grains = 0;
  if (!parse_number(std::string_view(options.grains), grains) || !(grains >= 2 && grains <= 1e9) ||
      grains != std::round(grains))
    throw_user_error({kSample, "--grains", options.grains, "be a whole number, 2 to 1e9, or thesis", ""});
  return grains;
}

/// m: beyond them it is another length unit.
constexpr double kSmallestGrain = 1e-9, kLargestGrain = 1e3;

void check(const SampleOptions& options) {
  if (std::filesystem::path(options.output).filename().empty())
    throw_user_error({kSample, "--output", options.output.empty() ? "nothing" : options.output,
                      "be the beginning of files' names", "for example samples/b20"});
  const auto must = [](bool fine, const char* option, double value, const char* rule,
                       const char* remedy = "") {
    if (!fine) throw_user_error({kSample, option, fmt::format("{:g}", value), rule, remedy});
  };
  if (options.smallest) must(*options.smallest > 0, "--smallest", *options.smallest, "be > 0", "in m");
  if (options.split) must(*options.split > 0, "--split", *options.split, "be > 0", "in m");
  if (options.solid_fraction)
    must(*options.solid_fraction > 0 && *options.solid_fraction < 0.74, "--solid-fraction",
         *options.solid_fraction, "be between 0 and 0.74");
  if (options.box_edge) must(*options.box_edge > 0, "--box-edge", *options.box_edge, "be > 0", "in m");
  if (options.box_height) {
    must(*options.box_height > 0, "--box-height", *options.box_height, "be > 0", "in m");
    if (!options.box_edge)
      throw_user_error({kSample, "--box-height", "without --box-edge", "go with it", "give both, in m"});
  }
  must(options.density > 0, "--density", options.density, "be > 0");
  must(options.coarse >= 1 && options.coarse <= 1e9 && options.coarse == std::round(options.coarse),
       "--coarse", options.coarse, "be a whole number, 1 to 1e9");
  must(options.scale > 0 && std::isfinite(options.scale), "--scale", options.scale, "be > 0");
  must(options.affordable >= 1, "--affordable", options.affordable, "be >= 1");
  if (options.classes < 2 || options.classes > 200)
    throw_user_error({kSample, "--classes", fmt::format("{}", options.classes), "be 2 to 200", ""});
}

/// The size between fines and coarse grains, and why; of the grading as it is, before --scale.
struct Split {
  double diameter = 0;
  std::string why;
};

Split split_of(const Grading& grading, const std::vector<GradingClass>& classes,
               const SampleOptions& options) {
  Split split{options.split.value_or(0), "given"};
  if (!options.split) {
    if (const auto& gap = grading.gap()) {
      // Between the classes themselves, as a simulation has them.
      const auto coarse = std::find_if(classes.begin(), classes.end(), [&](const GradingClass& one) {
        return one.diameter > gap->finer_diameter * (1 + 1e-9);
      });
      split = {std::sqrt((coarse - 1)->diameter * coarse->diameter), "in the gap"};
    } else {
      const GradingSplit rule = thesis_split(grading, 0);
      split = {grading.diameter_at(rule.finer),
               fmt::format("{:.3g} % finer, {}", 100 * rule.finer, rule.rule)};
    }
  }
  if (classes.back().diameter < split.diameter)
    throw_user_error({kSample, "--split", fmt::format("{:g} m", split.diameter),
                      fmt::format("be below the largest grain, {:g} m", classes.back().diameter), ""});
  return split;
}

struct Plan {
  Grading grading;
  double lost = 0;
  std::vector<GradingClass> classes;
  Split split;
  double for_coarse = 0;
  GrainSample sample;
  double box_edge = 0;
};

Plan plan_of(const SampleOptions& options, const std::optional<NamedGrading>& named) {
  Grading grading = grading_of_file(options.grading, kSample);
  Plan plan{grading, 0, {}, {}, 0, {}, 0};
  if (options.smallest) {
    CutGrading cut = cut_below(grading, *options.smallest);
    plan.grading = std::move(cut.grading);
    plan.lost = cut.lost;
  } else if (grading.unknown_below() > 0) {
    throw_user_error(
        {kSample, options.grading, curve_end(grading), "be known down to its smallest grain",
         fmt::format("cut it there with --smallest {:.4g}, or add a row with the smallest size and 0",
                     grading.smallest())});
  }
  plan.classes = sample_classes(plan.grading, options.classes);
  plan.split = split_of(plan.grading, plan.classes, options);
  plan.for_coarse = grains_with_coarse(plan.classes, options.coarse, plan.split.diameter);
  const double wanted = grains_wanted(options, named, plan.for_coarse);
  for (GradingClass& one : plan.classes) one.diameter *= options.scale;
  if (plan.classes.front().diameter < kSmallestGrain || plan.classes.back().diameter > kLargestGrain)
    throw_user_error({kSample, "--scale", fmt::format("{:g}", options.scale),
                      fmt::format("leave grains of {:g} to {:g} m, not of {:.3g} to {:.3g} m", kSmallestGrain,
                                  kLargestGrain, plan.classes.front().diameter, plan.classes.back().diameter),
                      ""});
  plan.split.diameter *= options.scale;
  plan.sample = grain_sample(plan.classes, wanted, plan.split.diameter);
  plan.box_edge = options.solid_fraction
                      ? std::cbrt(plan.sample.solids / *options.solid_fraction)
                      : placing_box_edge(plan.sample, placing_solid_fraction(plan.classes));
  return plan;
}

struct Cut {
  double smallest = 0;  ///< m, of the grading as it is
  double lost = 0;      ///< share of the mass that is finer
};

/// The least size up to `high`, m, from which on the classes of the grading need at most so many grains; none
/// where that cut does not help.
template <class Need>
std::optional<Cut> least_cut(const SampleOptions& options, const Plan& plan, double high, double grains,
                             const Need& need) {
  const auto need_from = [&](double smallest) {
    return need(sample_classes(cut_below(plan.grading, smallest).grading, options.classes));
  };
  double low = plan.grading.smallest();
  if (need_from(high) > grains) return std::nullopt;
  for (int k = 0; k < 40; ++k) {
    const double middle = std::sqrt(low * high);
    (need_from(middle) > grains ? low : high) = middle;
  }
  return Cut{high, cut_below(plan.grading, high).lost};
}

/// Sizes of which the sample has less than one grain: what they are of the mass, and what would hold them.
std::string rare_sizes_text(const SampleOptions& options, const Plan& plan) {
  std::size_t rare = 0;
  double mass = 0;
  for (const SampleClass& one : plan.sample.classes)
    if (one.grains < 1) {
      ++rare;
      mass += one.mass;
    }
  if (rare == 0) return "";
  std::string text = fmt::format(
      "warning: {} of {} sizes, {:.3g} % of the mass, have less than one grain: with one of each there are "
      "{:.4g} grains",
      rare, plan.sample.classes.size(), 100 * mass, std::ceil(grains_with_every_size(plan.classes)));
  const double high = plan.classes[plan.classes.size() - 2].diameter / options.scale;
  const auto cut = least_cut(options, plan, high, plan.sample.grains,
                             [](const auto& classes) { return grains_with_every_size(classes); });
  if (cut)
    text += fmt::format("; cut at --smallest {:.3g} (m) {:.0f} hold every size, without {:.3g} % of the mass",
                        cut->smallest, plan.sample.grains, 100 * cut->lost);
  return text + "; fewer --classes help too\n";
}

std::string notes_of(const SampleOptions& options, const Plan& plan) {
  const double largest = plan.classes.back().diameter, smallest = plan.classes.front().diameter;
  std::string text;
  if (plan.lost > 0)
    text += fmt::format("note: cut at {:.4g} mm: {:.3g} % of the mass are finer and left out\n",
                        1e3 * *options.smallest, 100 * plan.lost);
  if (plan.sample.coarse < options.coarse - 0.5)
    text += fmt::format(
        "note: {:.0f} coarse grains, fewer than {:g}: another seed will give another result; see how far "
        "they scatter\n",
        plan.sample.coarse, options.coarse);
  if (plan.for_coarse > options.affordable) {
    text += fmt::format(
        "warning: {:g} coarse grains take {:.4g} grains, more than {:g} (--affordable): the sizes span "
        "{:.0f}:1 ({:.4g} to {:.4g} mm)",
        options.coarse, plan.for_coarse, options.affordable, largest / smallest, 1e3 * smallest,
        1e3 * largest);
    const double split = plan.split.diameter / options.scale;
    if (const auto cut = least_cut(options, plan, split, options.affordable, [&](const auto& classes) {
          return grains_with_coarse(classes, options.coarse, split);
        }))
      text += fmt::format("; cut at --smallest {:.3g} (m) they take {:g}, without {:.3g} % of the mass\n",
                          cut->smallest, options.affordable, 100 * cut->lost);
    else
      text += "; no cut of the fines helps\n";
  }
  return text + rare_sizes_text(options, plan);
}

std::string screen_text(const SampleOptions& options, const Plan& plan) {
  const GrainSample& sample = plan.sample;
  std::string text = fmt::format("{:>12}  {:>9}  {:>10}\n", "diameter mm", "mass %", "grains");
  for (const SampleClass& one : sample.classes)
    text += fmt::format("{:>12.5g}  {:>9.4g}  {:>10.1f}\n", 1e3 * one.diameter, 100 * one.mass, one.grains);
  text +=
      fmt::format("{:.0f} grains, {:.0f} of them coarse; {:.3g} % of fines by mass, below {:.4g} mm ({})\n",
                  sample.grains, sample.coarse, 100 * sample.fines_share, 1e3 * sample.split, plan.split.why);
  text += fmt::format("{:g} coarse grains take {:.0f} grains\n", options.coarse, std::ceil(plan.for_coarse));
  text += fmt::format("box to place them in: {:.4g} mm wide, {:.3g} of it solid\n", 1e3 * plan.box_edge,
                      sample.solids / std::pow(plan.box_edge, 3));
  return text;
}

/// The files that a run writes: STEM and their ends.
std::vector<std::string> files_of(const SampleOptions& options) {
  std::vector<std::string> files{options.output + ".inc"};
  if (!options.variables_only)
    for (const char* end : {"_templates.inc", ".csv", ".data"}) files.push_back(options.output + end);
  return files;
}

void run(const SampleOptions& options) {
  check(options);
  options.outputs.require_new(kSample, {options.grading}, files_of(options));
  const std::optional<NamedGrading> named =
      is_there(options.grading) ? std::nullopt : named_grading(options.grading, kSample);
  const Plan plan = plan_of(options, named);
  SampleScript script{"",
                      plan.sample,
                      plan.box_edge,
                      options.box_height.value_or(0),
                      options.name,
                      named ? named->table_4_1 : "",
                      named ? named->table_5_1 : ""};
  if (script.name.empty())
    script.name = named ? named->name : std::filesystem::path(options.grading).stem().string();
  std::string made =
      fmt::format("suffuse-analyse sample {} --grains {:.0f}", options.grading, plan.sample.grains);
  if (options.smallest) made += fmt::format(" --smallest {:g}", *options.smallest);
  if (options.split) made += fmt::format(" --split {:g}", *options.split);
  if (options.scale != 1) made += fmt::format(" --scale {:g}", options.scale);
  if (options.classes != 20) made += fmt::format(" --classes {}", options.classes);
  if (options.solid_fraction) made += fmt::format(" --solid-fraction {:g}", *options.solid_fraction);
  script.title = script.name + ": written by " + made;
  const std::string who = "sample --output";
  if (options.box_edge) {
    constexpr double least_share = 1e-6;
    const double volume = std::pow(*options.box_edge, 2) * options.box_height.value_or(*options.box_edge);
    if (!(plan.sample.solids / volume > least_share))
      throw_user_error({kSample, "--box-edge", fmt::format("{:g} m", *options.box_edge),
                        fmt::format("be below {:.3g} m: the grains fill a millionth of such a cube",
                                    std::cbrt(plan.sample.solids / least_share)),
                        ""});
    script.box_edge = *options.box_edge;
  }
  SafeFile variables(options.output + ".inc", who);
  write_sample_variables(variables, script);
  if (options.variables_only) {
    variables.commit();
    if (!options.quiet) fmt::print("{}{}", screen_text(options, plan), notes_of(options, plan));
    return;
  }
  SafeFile templates(options.output + "_templates.inc", who), classes(options.output + ".csv", who);
  SafeFile data(options.output + ".data", who);
  write_sample_data(data, script, options.density, options.seed);
  write_sample_templates(templates, script);
  write_sample_classes(classes, script);
  for (SafeFile* file : {&variables, &templates, &classes, &data}) file->commit();
  if (!options.quiet) fmt::print("{}", screen_text(options, plan));
  fmt::print("{}", notes_of(options, plan));
}

}  // namespace

void add_sample(CLI::App& app) {
  auto options = std::make_shared<SampleOptions>();
  CLI::App* command = app.add_subcommand(
      kSample, "From a grading to grains for a simulation: classes, counts, box, LIGGGHTS templates");
  command
      ->add_option("PSD", options->grading,
                   "grading: CSV file or dump of grains, as in `grading`, or a name such as B20")
      ->required();
  command->add_option(
      "--grains", options->grains,
      "how many, or thesis: as many as it printed for this sample; as many as --coarse takes if not given");
  command->add_option("--coarse", options->coarse, "coarse grains that make a sample (thesis section 4.3)")
      ->capture_default_str();
  command->add_option("--smallest", options->smallest, "leave out grains below this diameter, m");
  command->add_option("--scale", options->scale, "all sizes times this")->capture_default_str();
  command->add_option(
      "--split", options->split,
      "fines are the grains of a smaller diameter, m; in the gap, or at (H/F)min, if not given");
  command->add_option("--classes", options->classes, "sizes that a curve is read as")->capture_default_str();
  command->add_option("--solid-fraction", options->solid_fraction,
                      "share of the box that the placed grains fill");
  command->add_option("--affordable", options->affordable, "number of grains above which to warn")
      ->capture_default_str();
  command->add_option("--name", options->name, "of the sample; the grading's if not given");
  command
      ->add_option("--output", options->output,
                   "STEM: writes STEM.inc, STEM.data, STEM_templates.inc, STEM.csv")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of the places; another one gives another sample")
      ->capture_default_str();
  command->add_option("--density", options->density, "of the grains, kg/m3")->capture_default_str();
  command->add_option("--box-edge", options->box_edge, "of the cube that the grains are placed in, m");
  command->add_option("--box-height", options->box_height, "along z, of a column in place of a cube, m");
  options->outputs.add_overwrite(*command);
  command->add_flag("--variables-only", options->variables_only, "write STEM.inc only");
  command->add_flag("--quiet", options->quiet, "notes and warnings only");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
