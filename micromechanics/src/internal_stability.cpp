#include "suffuse/micromechanics/internal_stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "suffuse/common/error.h"

namespace suffuse::micromechanics {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kLogOfFour = std::log10(4.0);

std::string size(double diameter) {
  return fmt::format("{:.4g} mm", 1e3 * diameter);
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

CriterionResult outside(CriterionResult result, std::string why) {
  result.value = kNaN;
  result.verdict = Verdict::not_applicable;
  result.note = std::move(why);
  return result;
}

std::string gap_or_continuous(const Grading& grading) {
  const auto& gap = grading.gap();
  return gap ? fmt::format("gap from {} to {} at {}", size(gap->finer_diameter), size(gap->coarser_diameter),
                           percent(gap->finer))
             : std::string("continuously graded");
}

/// Not applicable where the value needs a size below the end of the curve.
CriterionResult if_known(CriterionResult result, const Grading& grading) {
  return std::isnan(result.value) ? outside(std::move(result), curve_end(grading)) : result;
}

/// A criterion that searched the curve, of which an end may not be known.
CriterionResult if_searched(CriterionResult result, const Grading& grading, const StabilityLimits& limits) {
  if (grading.unknown_below() == 0) return result;
  if (!std::isfinite(result.value) && result.verdict != Verdict::unstable)
    return outside(std::move(result), curve_end(grading));
  if (result.verdict == Verdict::stable && grading.unknown_below() > limits.unknown_fines)
    return outside(result, fmt::format("{}; what is known gives {:.4g}", curve_end(grading), result.value));
  result.note += fmt::format("; searched as far as {}", curve_end(grading));
  return result;
}

/// Burenkova's conditional factors of uniformity h' = d90/d60 and h'' = d90/d15.
struct UniformityFactors {
  double coarse = 0, whole = 0;
};

UniformityFactors uniformity_factors(const Grading& grading) {
  const double d90 = grading.diameter_at(0.90);
  return {d90 / grading.diameter_at(0.60), d90 / grading.diameter_at(0.15)};
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::stable:
      return "stable";
    case Verdict::transitional:
      return "transitional";
    case Verdict::unstable:
      return "unstable";
    case Verdict::not_applicable:
      break;
  }
  return "not applicable";
}

const std::vector<LimitName>& limit_names() {
  using L = StabilityLimits;
  static const std::vector<LimitName> names = {{"usace_sand", &L::usace_sand},
                                               {"usace_gravel_diameter", &L::usace_gravel_diameter},
                                               {"istomina_stable", &L::istomina_stable},
                                               {"istomina_unstable", &L::istomina_unstable},
                                               {"lubochkov_chi", &L::lubochkov_chi},
                                               {"lubochkov", &L::lubochkov},
                                               {"kezdi", &L::kezdi},
                                               {"sherard", &L::sherard},
                                               {"kezdi_from_finer", &L::kezdi_from_finer},
                                               {"kenney_lau", &L::kenney_lau},
                                               {"kenney_lau_wide_finer", &L::kenney_lau_wide_finer},
                                               {"kenney_lau_narrow_finer", &L::kenney_lau_narrow_finer},
                                               {"kenney_lau_narrow_cu", &L::kenney_lau_narrow_cu},
                                               {"chapuis_finer", &L::chapuis_finer},
                                               {"burenkova_lower_slope", &L::burenkova_lower_slope},
                                               {"burenkova_lower_offset", &L::burenkova_lower_offset},
                                               {"burenkova_upper_slope", &L::burenkova_upper_slope},
                                               {"burenkova_upper_offset", &L::burenkova_upper_offset},
                                               {"honjo_gap_ratio", &L::honjo_gap_ratio},
                                               {"liu_unstable", &L::liu_unstable},
                                               {"liu_stable", &L::liu_stable},
                                               {"li_fannin_finer", &L::li_fannin_finer},
                                               {"wan_fell_probability", &L::wan_fell_probability},
                                               {"wan_fell_coarse", &L::wan_fell_coarse},
                                               {"wan_fell_fine", &L::wan_fell_fine},
                                               {"unknown_fines", &L::unknown_fines}};
  return names;
}

ShapeMinimum minimum_shape_ratio(const Grading& grading, const StabilityLimits& limits) {
  // Where d10 lies below the end of the curve, C_u is more than d60 over the size of that end.
  const double uniformity = grading_indices(grading).uniformity;
  const double at_least = grading.diameter_at(0.60) / grading.smallest();
  const bool narrow = (std::isnan(uniformity) ? at_least : uniformity) <= limits.kenney_lau_narrow_cu;
  ShapeMinimum least{kInfinity, 0, 0,
                     narrow || grading.gap() ? limits.kenney_lau_narrow_finer : limits.kenney_lau_wide_finer};
  for (const ShapePoint& point : shape_curve(grading, least.finer_limit)) {
    if (point.finer == 0) continue;  // H/F has no end there
    // Round-off of an H that is zero must not decide which of several zeros is named.
    const double ratio = std::max(0.0, point.interval / point.finer);
    if (ratio < least.ratio - 1e-12) least = {ratio, point.finer, point.diameter, least.finer_limit};
  }
  return least;
}

SplitMaximum maximum_split_ratio(const Grading& grading, double from_finer) {
  // Both sizes are straight in log d between the corners of the curve, so the largest ratio is at a split
  // where one of the two meets a corner, or at an end of the splits: with all of the curve as the fine part
  // (the corner at F = 1, where D15 of a vanishing coarse part is the largest grain), and with as little
  // fines as `from_finer`, or as have their d85 in what is known (the corner at the end of the curve).
  if (!(from_finer >= 0 && from_finer < 1))
    throw_user_error({"grading", "kezdi_from_finer", fmt::format("{:g}", from_finer),
                      "be at least 0 and below 1", "it is a share of the mass, not per cent"});
  std::vector<double> splits{from_finer};
  for (const GradingPoint& corner : grading.curve())
    for (const double split : {(corner.finer - 0.15) / 0.85, corner.finer / 0.85})
      if (split > from_finer && split <= 1 + 1e-12) splits.push_back(std::min(split, 1.0));
  SplitMaximum greatest;
  for (const double split : splits) {
    const double ratio =
        grading.diameter_above(split + 0.15 * (1 - split)) / grading.diameter_at(0.85 * split);
    if (ratio > greatest.ratio) greatest = {ratio, split};  // not where one of the sizes is unknown
  }
  return greatest;
}

CriterionResult usace(const Grading& grading, const StabilityLimits& limits) {
  CriterionResult result{"USACE",
                         "sand in sand and gravel",
                         0,
                         fmt::format("stable > {:g}", limits.usace_sand),
                         Verdict::not_applicable,
                         "usace1953",
                         ""};
  const double silt = grading.finer_at(0.075e-3), up_to_sand = grading.finer_at(limits.usace_gravel_diameter);
  if (std::isnan(silt) || std::isnan(up_to_sand)) return outside(result, curve_end(grading));
  if (up_to_sand >= 1 || up_to_sand <= silt) return outside(result, "for mixtures of gravel and sand only");
  result.value = (up_to_sand - silt) / (1 - silt);
  result.verdict = stable_if(result.value > limits.usace_sand);
  result.note = "four mixtures tested, no criterion proposed; the limit is Table 2.1's";
  return result;
}

CriterionResult istomina(const Grading& grading, const StabilityLimits& limits) {
  CriterionResult result{
      "Istomina",
      "Cu",
      grading_indices(grading).uniformity,
      fmt::format("stable <= {:g}, unstable >= {:g}", limits.istomina_stable, limits.istomina_unstable),
      Verdict::transitional,
      "istomina1957",
      "as reported by kovacs1981"};
  if (result.value <= limits.istomina_stable) result.verdict = Verdict::stable;
  if (result.value >= limits.istomina_unstable) result.verdict = Verdict::unstable;
  return if_known(result, grading);
}

CriterionResult lubochkov(const Grading& grading, const StabilityLimits& limits) {
  const double chi = limits.lubochkov_chi;
  CriterionResult result{"Lubochkov",
                         fmt::format("max of eq 2.1, chi = {:g}", chi),
                         -kInfinity,
                         fmt::format("stable < {:g}", limits.lubochkov),
                         Verdict::stable,
                         "lubochkov1969",
                         ""};
  if (!(chi > 1) || grading.largest() < chi * chi * grading.smallest())
    return outside(result, fmt::format("the sizes span less than a factor of chi^2 = {:g}", chi * chi));
  std::vector<double> corners;
  for (const GradingPoint& point : grading.curve())
    for (const double d : {point.diameter, point.diameter / chi, point.diameter * chi})
      if (d / chi >= grading.smallest() * (1 - 1e-12) && d * chi <= grading.largest() * (1 + 1e-12))
        corners.push_back(d);
  double where = 0;
  for (const double d : corners) {
    const double coarser = grading.finer_at(chi * d) - grading.finer_at(d);
    // Rounding must not lead below the end of the curve, where nothing is known.
    const double finer = grading.finer_at(d) - grading.finer_at(std::max(d / chi, grading.smallest()));
    if (coarser <= 1e-12) continue;
    const double value = finer > 1e-12 ? coarser / finer / std::pow(chi, 0.6) : kInfinity;
    if (value > result.value) {
      result.value = value;
      where = d;
    }
  }
  result.verdict = stable_if(result.value < limits.lubochkov);
  result.note = fmt::format("at {}; the thesis gives neither the side of the verdict nor chi", size(where));
  return if_searched(result, grading, limits);
}

namespace {

CriterionResult split_criterion(const Grading& grading, const char* name, const char* source, double limit,
                                double from_finer) {
  const SplitMaximum split = maximum_split_ratio(grading, from_finer);
  const std::string where = split.finer < 1 ? percent(split.finer) : "just below 100 %";
  return {name,
          "(D15c/d85f)max",
          split.ratio > 0 ? split.ratio : kNaN,
          fmt::format("stable <= {:g}", limit),
          stable_if(split.ratio <= limit),
          source,
          fmt::format("split at {}; {}", where, gap_or_continuous(grading))};
}

}  // namespace

CriterionResult kezdi(const Grading& grading, const StabilityLimits& limits) {
  CriterionResult result =
      split_criterion(grading, "Kezdi", "kezdi1979", limits.kezdi, limits.kezdi_from_finer);
  result.note += fmt::format("; at {:g} itself chapter 2 says stable, chapter 4 unstable", limits.kezdi);
  return if_searched(result, grading, limits);
}

CriterionResult sherard(const Grading& grading, const StabilityLimits& limits) {
  return if_searched(
      split_criterion(grading, "Sherard", "sherard1979", limits.sherard, limits.kezdi_from_finer), grading,
      limits);
}

CriterionResult kenney_lau(const Grading& grading, const StabilityLimits& limits) {
  const ShapeMinimum least = minimum_shape_ratio(grading, limits);
  CriterionResult result{"Kenney and Lau",
                         "(H/F)min",
                         least.ratio,
                         fmt::format("stable > {:g}", limits.kenney_lau),
                         stable_if(least.ratio > limits.kenney_lau),
                         "kenneylau1985",
                         fmt::format("at F = {}, {}; F up to {}", percent(least.finer), size(least.diameter),
                                     percent(least.finer_limit))};
  if (grading.gap())
    result.note += "; chapter 2 keeps it to gradings without a gap, Table 4.1 uses it with one";
  return if_searched(result, grading, limits);
}

CriterionResult chapuis_kezdi(const Grading& grading, const StabilityLimits& limits) {
  // Above d_max/4 the rest of the curve lies within a factor of four, and its slope falls to nothing at the
  // end.
  double least = kInfinity, where = 0;
  for (const ShapePoint& point : shape_curve(grading, 1))
    if (4 * point.diameter <= grading.largest() * (1 + 1e-12) && point.interval < least - 1e-12) {
      least = point.interval;
      where = point.diameter;
    }
  if (where == 0) {
    least = grading.unknown_below() > 0 ? kInfinity : 1;
    where = grading.smallest();
  }
  const CriterionResult result{
      "Chapuis, Kezdi's slope",
      "least slope per log cycle",
      std::max(0.0, least) / kLogOfFour,
      fmt::format("stable >= {:.3f}", limits.chapuis_finer / kLogOfFour),
      stable_if(least >= limits.chapuis_finer - 1e-9),
      "chapuis1992",
      fmt::format("from {} to four times it, searched up to a quarter of the largest grain", size(where))};
  return if_searched(result, grading, limits);
}

CriterionResult chapuis_kenney_lau(const Grading& grading, const StabilityLimits& limits) {
  const ShapeMinimum least = minimum_shape_ratio(grading, limits);
  const double slope = least.ratio * least.finer / kLogOfFour,
               needed = limits.kenney_lau * least.finer / kLogOfFour;
  const CriterionResult result{
      "Chapuis, Kenney and Lau's slope",
      "slope per log cycle",
      std::isfinite(least.ratio) ? slope : kNaN,
      fmt::format("stable > {:.3f}", needed),
      stable_if(least.ratio > limits.kenney_lau),
      "chapuis1992",
      fmt::format("at F = {}, where it is least against F/log 4; Kenney and Lau's criterion in other words",
                  percent(least.finer))};
  return if_searched(result, grading, limits);
}

CriterionResult burenkova(const Grading& grading, const StabilityLimits& limits) {
  const UniformityFactors h = uniformity_factors(grading);
  const double log_whole = std::log10(h.whole);
  const double lower = limits.burenkova_lower_slope * log_whole + limits.burenkova_lower_offset;
  const double upper = limits.burenkova_upper_slope * log_whole + limits.burenkova_upper_offset;
  CriterionResult result{"Burenkova",
                         "h' = d90/d60",
                         h.coarse,
                         fmt::format("stable in {:.3f} to {:.3f}", lower, upper),
                         stable_if(h.coarse > lower && h.coarse < upper),
                         "burenkova1993",
                         ""};
  const double printed = limits.burenkova_lower_slope * log_whole;
  const Verdict as_printed = stable_if(h.coarse > printed && h.coarse < upper);
  result.note = fmt::format(
      "h'' = d90/d15 = {:.3f}; misprinted in the thesis: eqs 2.2 and 2.3 call both h', eq 2.4 lacks + 1 "
      "in its lower bound ({:.3f}: {})",
      h.whole, printed, to_string(as_printed));
  if (std::isnan(h.whole)) {
    result.value = kNaN;
    result.limit = "by d90/d15";
  }
  return if_known(result, grading);
}

CriterionResult honjo(const Grading& grading, const StabilityLimits& limits) {
  CriterionResult result{
      "Honjo",         "gap ratio", 0, fmt::format("stable <= {:g}", limits.honjo_gap_ratio),
      Verdict::stable, "honjo1996", ""};
  if (!grading.gap())
    return outside(result, grading.unknown_below() > limits.unknown_fines
                               ? "no gap in what is known: " + curve_end(grading)
                               : std::string("continuously graded"));
  result.value = grading.gap()->ratio();
  result.verdict = stable_if(result.value <= limits.honjo_gap_ratio);
  result.note = gap_or_continuous(grading);
  if (grading.gap()->class_ratio > 0)
    result.note += fmt::format("; {:.3g} between the classes' own sizes", grading.gap()->class_ratio);
  return result;
}

CriterionResult liu(const Grading& grading, const StabilityLimits& limits) {
  const double division = std::sqrt(grading.diameter_at(0.70) * grading.diameter_at(0.10));
  const double fines = grading.gap() ? grading.gap()->finer : grading.finer_at(division);
  CriterionResult result{
      "Liu",
      "fines content P",
      fines,
      fmt::format("unstable < {:g}, stable > {:g}", limits.liu_unstable, limits.liu_stable),
      Verdict::transitional,
      "liu2005",
      grading.gap() ? "at the gap" : fmt::format("finer than sqrt(d70 d10) = {}", size(division))};
  constexpr double rounding = 1e-9;
  if (fines < limits.liu_unstable - rounding) result.verdict = Verdict::unstable;
  if (fines > limits.liu_stable + rounding) result.verdict = Verdict::stable;
  return if_known(result, grading);
}

CriterionResult li_fannin(const Grading& grading, const StabilityLimits& limits) {
  const double finer_limit = minimum_shape_ratio(grading, limits).finer_limit;
  double least = kInfinity, where = 0, least_other = kInfinity;
  for (const ShapePoint& point : shape_curve(grading, finer_limit)) {
    const double line = limits.kenney_lau * point.finer;
    const double strict = std::max(0.0, point.interval) / std::max(limits.li_fannin_finer, line);
    if (strict < least - 1e-12) {
      least = strict;
      where = point.finer;
    }
  }
  // The less strict line has its corner, at which a minimum may lie, where Kezdi's takes over.
  for (const double end : {std::min(limits.li_fannin_finer, finer_limit), finer_limit})
    for (const ShapePoint& point : shape_curve(grading, end))
      if (const double line = limits.kenney_lau * point.finer; line > 0)
        least_other = std::min(least_other, point.interval / std::min(limits.li_fannin_finer, line));
  const CriterionResult result{
      "Li and Fannin",
      fmt::format("least H/max({:g}, F)", limits.li_fannin_finer),
      least,
      "stable > 1",
      stable_if(least > 1),
      "lifannin2008",
      fmt::format("at F = {}; the stricter of Kezdi's and Kenney and Lau's line, as Table 2.1 has it; "
                  "with the less strict, "
                  "H/min({:g}, F): {}",
                  percent(where), limits.li_fannin_finer, to_string(stable_if(least_other > 1)))};
  return if_searched(result, grading, limits);
}

CriterionResult wan_fell_probability(const Grading& grading, const StabilityLimits& limits) {
  const UniformityFactors h = uniformity_factors(grading);
  const auto probability = [](double z) { return 1 / (1 + std::exp(-z)); };
  const double silty = probability(2.378 * std::log10(h.whole) - 3.648 * h.coarse + 3.701);
  const double clean = probability(3.875 * std::log10(h.whole) - 3.591 * h.coarse + 2.436);
  const bool is_silty = grading.finer_at(0.075e-3) > 0.10;
  const double value = std::isnan(grading.finer_at(0.075e-3)) ? kNaN : is_silty ? silty : clean;
  const CriterionResult result{
      "Wan and Fell, probability",
      "probability of instability",
      value,
      fmt::format("stable < {:g}", limits.wan_fell_probability),
      stable_if(value < limits.wan_fell_probability),
      "wanfell2008",
      fmt::format("logistic in h', h'' for {}; without formula in the thesis",
                  is_silty ? "more than 10 % below 0.075 mm" : "up to 10 % below 0.075 mm")};
  return if_known(result, grading);
}

CriterionResult wan_fell_slopes(const Grading& grading, const StabilityLimits& limits) {
  const double coarse = 30 / std::log10(grading.diameter_at(0.90) / grading.diameter_at(0.60));
  const double fine = 15 / std::log10(grading.diameter_at(0.20) / grading.diameter_at(0.05));
  CriterionResult result{
      "Wan and Fell, slopes",
      "30/log(d90/d60)",
      coarse,
      fmt::format("stable < {:g} or fine slope > {:g}", limits.wan_fell_coarse, limits.wan_fell_fine),
      stable_if(coarse < limits.wan_fell_coarse || fine > limits.wan_fell_fine),
      "wanfell2008",
      fmt::format(
          "fine slope 15/log(d20/d5) = {:.3g}; for broadly graded soils; without formula in the thesis",
          fine)};
  if (grading.gap()) return outside(result, "for broadly graded soils, not with a gap");
  if (std::isnan(fine)) result.value = kNaN;
  return if_known(result, grading);
}

std::vector<CriterionResult> grading_criteria(const Grading& grading, const StabilityLimits& limits) {
  using Group = CriterionGroup;
  using Criterion = CriterionResult (*)(const Grading&, const StabilityLimits&);
  static constexpr std::pair<Criterion, Group> criteria[] = {{usace, Group::one_number},
                                                             {istomina, Group::one_number},
                                                             {lubochkov, Group::shape_of_curve},
                                                             {kezdi, Group::sizes_of_parts},
                                                             {sherard, Group::sizes_of_parts},
                                                             {kenney_lau, Group::shape_of_curve},
                                                             {chapuis_kezdi, Group::sizes_of_parts},
                                                             {chapuis_kenney_lau, Group::shape_of_curve},
                                                             {burenkova, Group::size_ratios},
                                                             {honjo, Group::one_number},
                                                             {liu, Group::one_number},
                                                             {wan_fell_probability, Group::size_ratios},
                                                             {wan_fell_slopes, Group::size_ratios},
                                                             {li_fannin, Group::shape_of_curve}};
  std::vector<CriterionResult> results;
  for (const auto& [criterion, group] : criteria) {
    results.push_back(criterion(grading, limits));
    results.back().group = group;
  }
  return results;
}

}  // namespace suffuse::micromechanics
