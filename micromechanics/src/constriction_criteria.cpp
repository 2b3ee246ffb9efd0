#include "suffuse/micromechanics/constriction_criteria.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/grain_sample.h"

namespace suffuse::micromechanics {

namespace {

void check_share(const char* what, double value, bool open) {
  const bool inside = open ? value > 0 && value < 1 : value >= 0 && value <= 1;
  if (!inside)
    throw_user_error({"constriction", what, fmt::format("{:g}", value),
                      open ? "be between 0 and 1, ends excluded" : "be between 0 and 1",
                      "give a share, not per cent"});
}

std::string micrometres(double diameter) {
  return fmt::format("{:.4g} um", 1e6 * diameter);
}

}  // namespace

const std::vector<ConstrictionLimitName>& constriction_limit_names() {
  using L = ConstrictionLimits;
  static const std::vector<ConstrictionLimitName> names = {
      {"filter_2007", &L::filter_2007},     {"stable_2011", &L::stable_2011},
      {"unstable_2011", &L::unstable_2011}, {"chapter_4", &L::chapter_4},
      {"stable_2015", &L::stable_2015},     {"cyclic_2017", &L::cyclic_2017},
      {"coordination", &L::coordination},   {"stress_reduction", &L::stress_reduction},
      {"fines_split", &L::fines_split},     {"dense_split", &L::dense_split},
      {"dense_from", &L::dense_from},       {"split_margin", &L::split_margin}};
  return names;
}

GradingSplit thesis_split(const Grading& grading, double relative_density, const ConstrictionLimits& limits,
                          const StabilityLimits& stability) {
  constexpr double rounding = 1e-9;
  if (!grading.gap())
    return {minimum_shape_ratio(grading, stability).finer, "at (H/F)min, continuously graded"};
  const double fines = grading.gap()->finer;
  if (fines < limits.fines_split - rounding) return {fines, "at the gap"};
  if (relative_density >= limits.dense_from)
    return {limits.dense_split, fmt::format("gap at {:g} or more fines, dense", limits.fines_split)};
  return {limits.fines_split, fmt::format("gap at {:g} or more fines, loose or medium", limits.fines_split)};
}

std::vector<GradingSplit> allowed_splits(const Grading& grading, const ConstrictionLimits& limits,
                                         const StabilityLimits& stability) {
  if (!grading.gap()) return {thesis_split(grading, 0, limits, stability)};
  const double fines = grading.gap()->finer;
  std::vector<GradingSplit> splits{{fines, "at the gap"}};
  if (fines < limits.fines_split - limits.split_margin) return splits;
  for (const auto& [finer, rule] :
       {std::pair{limits.fines_split, "as the thesis does in loose and medium states"},
        std::pair{limits.dense_split, "as it does in dense ones"}})
    if (finer < fines - 1e-9) splits.push_back({finer, rule});
  return splits;
}

double diameter_by_fraction(std::span<const GradingClass> classes, FractionBy by, double finer) {
  const std::vector<double> fractions = class_fractions(classes, by);
  std::vector<GradingClass> weighted(classes.begin(), classes.end());
  for (std::size_t i = 0; i < weighted.size(); ++i) weighted[i].mass = fractions[i];
  return Grading::from_classes(weighted).diameter_at(finer);
}

double predicted_coordination(double ratio) {
  return 5 / (1 + std::exp(10 * ratio - 6.2));
}

double predicted_stress_reduction(double ratio) {
  return 0.16 + 1.2 / (1 + std::exp(14 * ratio - 9.5));
}

ConstrictionAnalysis analyse_constrictions(const Grading& grading, const ConstrictionOptions& options,
                                           const ConstrictionLimits& limits,
                                           const StabilityLimits& stability) {
  check_share("relative density", options.relative_density, false);
  if (options.split) check_share("split", *options.split, true);
  if (options.porosity) check_share("porosity", *options.porosity, true);
  if (grading.unknown_below() > 0)
    throw_user_error({"constriction", "grading", curve_end(grading), "be known down to its smallest grain",
                      "add the size than which no grain is finer, with 0"});
  ConstrictionAnalysis result;
  result.split = options.split ? GradingSplit{*options.split, "given"}
                               : thesis_split(grading, options.relative_density, limits, stability);
  std::tie(result.fine, result.coarse) =
      split_classes(sample_classes(grading, options.classes), result.split.finer);
  result.sizes = constriction_sizes(result.coarse, options.fractions, options.pore);
  result.controlling = result.sizes.at(0.35, options.relative_density);
  result.controlling_loosest = result.sizes.at(0.35, 0);
  result.largest_erodible = diameter_by_fraction(result.fine, options.fractions, 0.85);
  result.coordination = predicted_coordination(result.ratio());
  result.stress_reduction = predicted_stress_reduction(result.ratio());
  if (options.porosity)
    result.kovacs_pore = kovacs_pore_diameter(
        result.coarse, skeleton_porosity(*options.porosity, result.split.finer), options.kovacs_shape);
  return result;
}

std::vector<CriterionResult> constriction_criteria(const ConstrictionAnalysis& analysis,
                                                   const ConstrictionOptions& options,
                                                   const ConstrictionLimits& limits) {
  const double ratio = analysis.ratio();
  const std::string where =
      fmt::format("split at {:.3g} % ({})", 100 * analysis.split.finer, analysis.split.rule);
  std::vector<CriterionResult> results;
  if (analysis.kovacs_pore) {
    const double base = diameter_by_fraction(analysis.fine, FractionBy::mass, 0.85);
    const double pore = *analysis.kovacs_pore;
    results.push_back(
        {"Kovacs", "d0/d85f", pore / base, "stable < 1", stable_if(pore < base), "kovacs1981",
         fmt::format("mean tube {} at skeleton porosity {:.3f}; the thesis calls eq 2.7 a criterion for "
                     "instability, its inequality is the stable side",
                     micrometres(pore), skeleton_porosity(*options.porosity, analysis.split.finer))});
  }
  results.push_back(
      {"Indraratna 2007, filter", "Dc35/d85f", ratio, fmt::format("stable <= {:g}", limits.filter_2007),
       stable_if(ratio <= limits.filter_2007), "indraratna2007", "coarse as filter of fine; " + where});
  Verdict verdict = Verdict::transitional;
  if (ratio < limits.stable_2011) verdict = Verdict::stable;
  if (ratio > limits.unstable_2011) verdict = Verdict::unstable;
  results.push_back({"Indraratna 2011", "Dc35/d85f", ratio,
                     fmt::format("stable < {:g}, unstable > {:g}", limits.stable_2011, limits.unstable_2011),
                     verdict, "indraratna2011", "Table 2.1 misprints > 0.82 as stable"});
  results.push_back({"Chapter 4 of the thesis", "Dc35/d85f", ratio,
                     fmt::format("unstable >= {:g}", limits.chapter_4), stable_if(ratio < limits.chapter_4),
                     "haq", "no transition, other than in chapter 2"});
  results.push_back({"Indraratna 2015", "Dc35/d85f", ratio, fmt::format("stable <= {:g}", limits.stable_2015),
                     stable_if(ratio <= limits.stable_2015), "indraratna2015", where});
  const double loosest = analysis.loosest_ratio();
  results.push_back({"Israr and Indraratna 2017, cyclic", "Dc35/d85f at Rd = 0", loosest,
                     fmt::format("stable <= {:g}", limits.cyclic_2017),
                     stable_if(loosest <= limits.cyclic_2017), "israrindraratna2017", "loosest state"});
  for (CriterionResult& result : results) result.group = CriterionGroup::constrictions;
  results.push_back({"Z by eq 4.7", "Z", analysis.coordination,
                     fmt::format("unstable <= {:g}", limits.coordination),
                     stable_if(analysis.coordination > limits.coordination), "haq",
                     "a fit; 0.69 rms off the thesis's own Table 4.1", CriterionGroup::predicted});
  results.push_back({"Stress reduction by eq 4.8", "alpha", analysis.stress_reduction,
                     fmt::format("unstable <= {:g}", limits.stress_reduction),
                     stable_if(analysis.stress_reduction > limits.stress_reduction), "haq",
                     "a fit; 0.23 rms off the thesis's own Table 4.1", CriterionGroup::predicted});
  return results;
}

}  // namespace suffuse::micromechanics
