#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "suffuse/micromechanics/constriction_size.h"
#include "suffuse/micromechanics/internal_stability.h"

namespace suffuse::micromechanics {

/// Limits on D_c35 of the coarse over d85 of the fine fraction, with the thesis's values.
struct ConstrictionLimits {
  double filter_2007 = 1;         ///< base retained up to
  double stable_2011 = 0.73;      ///< stable below
  double unstable_2011 = 0.82;    ///< unstable above; between the two transitional
  double chapter_4 = 0.73;        ///< unstable from (thesis chapter 4)
  double stable_2015 = 1;         ///< stable up to
  double cyclic_2017 = 1;         ///< stable up to, in the loosest state
  double coordination = 1;        ///< Z up to which unstable (thesis chapter 4)
  double stress_reduction = 0.5;  ///< α up to which unstable (thesis chapter 4)
  double fines_split = 0.25;      ///< with at least these fines at the gap, the split is here,
  double dense_split = 0.20;      ///< and here in the dense state (thesis chapter 4)
  double dense_from = 0.65;       ///< relative density from which a state is dense (the thesis's is 0.95)
  double split_margin = 0.025;    ///< fines so close below fines_split may be either (allowed_splits)
};

/// A limit that can be set by name; none of the names is one of StabilityLimits.
struct ConstrictionLimitName {
  std::string_view name;
  double ConstrictionLimits::*member;
};
const std::vector<ConstrictionLimitName>& constriction_limit_names();

/// Where a grading is cut into filter and base, and by which rule.
struct GradingSplit {
  double finer = 0;  ///< share of the mass, 0 to 1
  std::string rule;
};

/// The thesis's rule (chapter 4): at (H/F)min where continuous; at the gap with less than 25 % of fines; at
/// 25 % with more, 20 % in the dense state.
GradingSplit thesis_split(const Grading& grading, double relative_density,
                          const ConstrictionLimits& limits = {}, const StabilityLimits& stability = {});

/// Every split that the sources allow: of a continuous grading that at (H/F)min; of a gap-graded one that at
/// the gap (Indraratna 2015), and, with at least fines_split - split_margin of fines, those at fines_split
/// and dense_split (chapter 4). A verdict that they do not share hangs on a rule and not on the soil.
std::vector<GradingSplit> allowed_splits(const Grading& grading, const ConstrictionLimits& limits = {},
                                         const StabilityLimits& stability = {});

struct ConstrictionOptions {
  double relative_density = 0;  ///< R_d, 0 to 1
  FractionBy fractions = FractionBy::surface_area;
  LoosePore pore = LoosePore::inscribed;
  std::size_t classes = 20;        ///< the grading is read as at most so many classes
  std::optional<double> split;     ///< share finer; the thesis's rule if not given
  std::optional<double> porosity;  ///< of the soil, for Kovacs's tubes
  double kovacs_shape = 6;         ///< α_d
};

/// Everything that the criteria need.
struct ConstrictionAnalysis {
  GradingSplit split;
  std::vector<GradingClass> fine, coarse;  ///< normalised
  ConstrictionSizes sizes;                 ///< of the coarse fraction
  double controlling = 0;                  ///< D_c35 at the relative density, m
  double controlling_loosest = 0;          ///< D_c35 at R_d = 0, m
  double largest_erodible = 0;             ///< d85 of the fine fraction by `fractions`, m
  double ratio() const { return controlling / largest_erodible; }
  double loosest_ratio() const { return controlling_loosest / largest_erodible; }
  double coordination = 0;            ///< Z of eq 4.7
  double stress_reduction = 0;        ///< α of eq 4.8
  std::optional<double> kovacs_pore;  ///< m, of the coarse fraction as skeleton
};

/// Throws UserError on a relative density, split or porosity out of range.
ConstrictionAnalysis analyse_constrictions(const Grading& grading, const ConstrictionOptions& options,
                                           const ConstrictionLimits& limits = {},
                                           const StabilityLimits& stability = {});

/// Z = 5/(1 + exp(10 x − 6.2)) (thesis eq 4.7).
double predicted_coordination(double ratio);
/// α = 0.16 + 1.2/(1 + exp(14 x − 9.5)) (thesis eq 4.8).
double predicted_stress_reduction(double ratio);

/// Size up to which the share `finer` of fractions (mass, number or surface area) of classes lies, the
/// classes spread over log d as in Grading, m.
double diameter_by_fraction(std::span<const GradingClass> classes, FractionBy by, double finer);

/// Kovacs (if a porosity was given), Indraratna 2007, 2011, chapter 4 of the thesis, 2015, 2017, and Z, α by
/// eqs 4.7, 4.8.
std::vector<CriterionResult> constriction_criteria(const ConstrictionAnalysis& analysis,
                                                   const ConstrictionOptions& options,
                                                   const ConstrictionLimits& limits = {});

}  // namespace suffuse::micromechanics
