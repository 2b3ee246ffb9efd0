#include "grading/constriction_command.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "files/output_options.h"
#include "grading/constriction_table.h"
#include "grading/criteria_table.h"
#include "grading/grain_snapshot.h"
#include "grading/packing_constrictions.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/constriction_criteria.h"

namespace suffuse::analysis {
namespace {

using micromechanics::ConstrictionAnalysis;
using micromechanics::ConstrictionOptions;
using micromechanics::FractionBy;
using micromechanics::LoosePore;
using micromechanics::SizeDistribution;

constexpr const char* kConstriction = "constriction";

struct ConstrictionRequest {
  OutputOptions outputs;
  std::string grading, packing, output, distribution, prediction, discs;
  std::string fractions = "surface-area", pore = "inscribed";
  ConstrictionOptions analysis;
  std::optional<std::int64_t> step;
  double merge_overlap = 0.5, coarser_than = 0;
  std::vector<std::string> limits;
};

void write_discs(SafeFile& file, const PackingConstrictions& found) {
  file.write("x_m,y_m,z_m,normal_x,normal_y,normal_z,diameter_m\n");
  for (const Constriction& one : found.constrictions)
    file.write(fmt::format("{},{},{},{},{},{},{}\n", one.centre.x(), one.centre.y(), one.centre.z(),
                           one.normal.x(), one.normal.y(), one.normal.z(), one.diameter));
}

PackingConstrictions measure_packing(const ConstrictionRequest& options, std::string& text) {
  GrainSnapshot snapshot = read_grain_snapshot(options.packing, kConstriction, true, options.step);
  const std::size_t all = snapshot.grains.size();
  std::erase_if(snapshot.grains,
                [&](const Sphere& grain) { return 2 * grain.radius < options.coarser_than; });
  const PackingConstrictions found =
      packing_constrictions(snapshot.grains, snapshot.box, options.merge_overlap);
  if (found.constrictions.empty())
    throw_user_error(
        {kConstriction, options.packing, "no constriction", "have pores between its grains", ""});
  text = fmt::format(
      "packing at step {}: {} of {} grains, {} cells, {} pores, {} constrictions, {} closed faces\n",
      snapshot.step, snapshot.grains.size(), all, found.cells, found.pore_diameters.size(),
      found.constrictions.size(), found.closed);
  return found;
}

SizeDistribution distribution_of(const PackingConstrictions& found) {
  std::vector<std::pair<double, double>> sizes;
  for (const Constriction& one : found.constrictions) sizes.emplace_back(one.diameter, 1.0);
  return micromechanics::size_distribution(std::move(sizes));
}

std::string sizes_text(const char* of, double d0, double d35, double d50, double d100) {
  return fmt::format(
      "constrictions of the {}, um: smallest {:.4g}, Dc35 {:.4g}, Dc50 {:.4g}, largest {:.4g}\n", of,
      1e6 * d0, 1e6 * d35, 1e6 * d50, 1e6 * d100);
}

std::string analysis_text(const ConstrictionAnalysis& analysis, const ConstrictionRequest& options) {
  const auto at = [&](double share) { return analysis.sizes.at(share, options.analysis.relative_density); };
  ConstrictionOptions other = options.analysis;
  other.pore = other.pore == LoosePore::inscribed ? LoosePore::equal_area : LoosePore::inscribed;
  const double controlling = micromechanics::constriction_sizes(analysis.coarse, other.fractions, other.pore)
                                 .at(0.35, other.relative_density);
  return fmt::format("split at {:.3g} % ({}); relative density {:g}; fractions by {}; loose pores {}\n",
                     100 * analysis.split.finer, analysis.split.rule, options.analysis.relative_density,
                     options.fractions, options.pore) +
         sizes_text("coarse fraction", at(0), at(0.35), at(0.5), at(1)) +
         fmt::format("d85 of the fine fraction {:.4g} um; Dc35/d85 {:.4g} (with {} loose pores {:.4g})\n",
                     1e6 * analysis.largest_erodible, analysis.ratio(),
                     other.pore == LoosePore::inscribed ? "inscribed" : "equal-area",
                     controlling / analysis.largest_erodible);
}

void check(ConstrictionRequest& options) {
  if (options.grading.empty() && options.packing.empty())
    throw_user_error({kConstriction, "PSD", "nothing", "be given, or --packing", "see --help"});
  if (options.grading.empty() && !(options.output.empty() && options.prediction.empty()))
    throw_user_error({kConstriction, "--output, --prediction", "without a PSD", "have a grading to judge",
                      "give one before --packing"});
  if (options.packing.empty() && !options.discs.empty())
    throw_user_error({kConstriction, "--discs", options.discs, "have a packing", "give --packing"});
  options.analysis.fractions = fraction_names().at(options.fractions);
  options.analysis.pore = pore_names().at(options.pore);
  if (options.analysis.classes < 2 || options.analysis.classes > 40)
    throw_user_error(
        {kConstriction, "--classes", fmt::format("{}", options.analysis.classes), "be 2 to 40", ""});
}

void run(ConstrictionRequest& options) {
  check(options);
  options.outputs.require_new(kConstriction, {options.grading, options.packing});
  micromechanics::ConstrictionLimits limits;
  micromechanics::StabilityLimits stability;
  set_limits(options.limits, kConstriction, stability, &limits);
  std::optional<micromechanics::Grading> grading;
  std::optional<ConstrictionAnalysis> analysis;
  std::vector<micromechanics::CriterionResult> results;
  std::string text;
  if (!options.grading.empty()) {
    grading = grading_of_file(options.grading, kConstriction);
    analysis = micromechanics::analyse_constrictions(*grading, options.analysis, limits, stability);
    results = micromechanics::constriction_criteria(*analysis, options.analysis, limits);
    text = grading_text(*grading) + analysis_text(*analysis, options) + "\n" + criteria_text(results);
  }
  std::optional<PackingConstrictions> found;
  std::optional<SizeDistribution> of_packing;
  if (!options.packing.empty()) {
    std::string packing_text;
    found = measure_packing(options, packing_text);
    of_packing = distribution_of(*found);
    text += packing_text + sizes_text("packing, by number", of_packing->diameters.front(),
                                      of_packing->quantile(0.35), of_packing->quantile(0.5),
                                      of_packing->diameters.back());
  }
  std::optional<SafeFile> output, distribution, prediction, discs;
  if (!options.output.empty())
    write_criteria(output.emplace(options.output, "constriction --output"), results);
  if (!options.distribution.empty())
    write_distribution(distribution.emplace(options.distribution, "constriction --distribution"),
                       options.analysis, analysis, of_packing);
  if (!options.prediction.empty())
    write_prediction(prediction.emplace(options.prediction, "constriction --prediction"), *grading,
                     options.analysis, limits, stability);
  if (!options.discs.empty()) write_discs(discs.emplace(options.discs, "constriction --discs"), *found);
  for (auto* file : {&output, &distribution, &prediction, &discs})
    if (*file) (*file)->commit();
  fmt::print("{}", text);
}

void add_grading_options(CLI::App& command, ConstrictionRequest& options) {
  std::vector<std::string> fractions, pores;
  for (const auto& [name, value] : fraction_names()) fractions.push_back(name);
  for (const auto& [name, value] : pore_names()) pores.push_back(name);
  command.add_option("PSD", options.grading, "grading: CSV file or dump of grains, as in `grading`");
  command.add_option("--relative-density", options.analysis.relative_density, "0 (loosest) to 1 (densest)")
      ->capture_default_str();
  command.add_option("--fractions", options.fractions, "probability of a class by")
      ->check(CLI::IsMember(fractions))
      ->capture_default_str();
  command
      .add_option("--loose-pore", options.pore, "hole between four grains: disc inscribed, or of equal area")
      ->check(CLI::IsMember(pores))
      ->capture_default_str();
  command.add_option("--split", options.analysis.split,
                     "share finer at which fine and coarse are cut; the thesis's rule if not given");
  command.add_option("--porosity", options.analysis.porosity, "of the soil, for Kovacs's criterion");
  command.add_option("--classes", options.analysis.classes, "the grading is read as at most so many classes")
      ->capture_default_str();
  command.add_option("--limit", options.limits,
                     "another limit, of these criteria or of the split's rule, name=value, such as "
                     "chapter_4=0.8; may be repeated");
}

}  // namespace

void add_constriction(CLI::App& app) {
  auto options = std::make_shared<ConstrictionRequest>();
  CLI::App* command = app.add_subcommand(
      kConstriction, "Constriction sizes of a grading or of an actual packing, and the criteria on them");
  add_grading_options(*command, *options);
  CLI::Option* packing = command->add_option(
      "--packing", options->packing, "dump of grains with x y z radius: constrictions of the packing itself");
  command->add_option("--step", options->step, "its step; the last one if not given")->needs(packing);
  command
      ->add_option("--coarser-than", options->coarser_than,
                   "leave out grains below this diameter (m): the skeleton alone")
      ->capture_default_str()
      ->needs(packing);
  command
      ->add_option(
          "--merge-overlap", options->merge_overlap,
          "void spheres are one pore if they overlap by more than this share of the smaller diameter")
      ->capture_default_str()
      ->needs(packing);
  options->outputs.add(*command, "--output", options->output, "CSV file with the criteria");
  options->outputs.add(*command, "--distribution", options->distribution, "CSV file with the distributions");
  options->outputs.add(*command, "--prediction", options->prediction,
                       "CSV file with Dc35/d85, Z and alpha over the relative density");
  options->outputs.add(*command, "--discs", options->discs,
                       "CSV file with every constriction of the packing");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
