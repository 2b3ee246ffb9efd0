#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "suffuse/micromechanics/grading.h"

namespace suffuse::micromechanics {

enum class Verdict { stable, transitional, unstable, not_applicable };

/// "stable", "transitional", "unstable", "not applicable".
const char* to_string(Verdict verdict);
inline Verdict stable_if(bool stable) {
  return stable ? Verdict::stable : Verdict::unstable;
}

/// What one criterion says of a soil.
/// What a criterion looks at; those that look at the same thing have one vote in a report.
enum class CriterionGroup {
  sizes_of_parts,  ///< of the coarse and the fine part of the grading
  shape_of_curve,
  one_number,   ///< gap, fines or uniformity
  size_ratios,  ///< of coarse and fine sizes
  constrictions,
  predicted,  ///< Z and alpha by eqs 4.7 and 4.8
  measured    ///< Z and alpha of a sample
};

struct CriterionResult {
  std::string criterion;  ///< "Kenney and Lau"
  std::string measure;    ///< "(H/F)min"
  double value = 0;       ///< NaN where the criterion does not apply
  std::string limit;      ///< "stable > 1"
  Verdict verdict = Verdict::not_applicable;
  std::string source;  ///< key of docs/references.bib
  std::string note;    ///< where it was read, what the thesis prints otherwise; may be empty
  CriterionGroup group = CriterionGroup::measured;
};

/// Limits of the criteria on the grading, with the thesis's values (chapter 2; where it misprints one, the
/// source's). Shares and sizes as in Grading.
struct StabilityLimits {
  double usace_sand = 0.5;                 ///< stable above this share of sand in sand and gravel
  double usace_gravel_diameter = 4.75e-3;  ///< m: sand is finer (sieve no. 4), coarser than 0.075 mm
  double istomina_stable = 10;             ///< C_u up to which stable
  double istomina_unstable = 20;           ///< C_u from which unstable
  double lubochkov_chi = 2;                ///< χ of eq 2.1; the thesis names no value
  double lubochkov = 1;                    ///< stable below
  double kezdi = 4;                        ///< D15c/d85f up to which stable
  double sherard = 5;                      ///< the same in Sherard's version
  double kezdi_from_finer =
      0;                  ///< F from which splits are searched; Table 4.1's ratios are those from 5 % on
  double kenney_lau = 1;  ///< (H/F)min above which stable (1.3 before the discussion of 1986)
  double kenney_lau_wide_finer = 0.20;    ///< F searched, widely graded
  double kenney_lau_narrow_finer = 0.30;  ///< F searched, narrowly graded, and gap-graded (as Table 4.1 does)
  double kenney_lau_narrow_cu = 3;        ///< C_u up to which a soil is narrowly graded
  double chapuis_finer = 0.15;            ///< unstable below this share per factor of four in size
  double burenkova_lower_slope = 0.76;    ///< stable: lower < h' < upper, each slope × log10 h'' + offset
  double burenkova_lower_offset = 1;
  double burenkova_upper_slope = 1.86;
  double burenkova_upper_offset = 1;
  double honjo_gap_ratio = 4;         ///< stable up to
  double liu_unstable = 0.25;         ///< fines content below which unstable
  double liu_stable = 0.35;           ///< above which stable
  double li_fannin_finer = 0.15;      ///< F at which Kezdi's line gives way to Kenney and Lau's
  double wan_fell_probability = 0.5;  ///< of the logistic form: unstable above
  double wan_fell_coarse = 80;        ///< 30/log10(d90/d60) up to which stable
  double wan_fell_fine = 22;          ///< 15/log10(d20/d5) from which stable
  /// Share of the mass below the end of the curve up to which criteria that search the curve may say stable.
  double unknown_fines = 0.05;
};

/// A limit that can be set by name.
struct LimitName {
  std::string_view name;
  double StabilityLimits::*member;
};
const std::vector<LimitName>& limit_names();

/// (H/F)min and where it is. `finer_limit`: the F up to which it was searched. Where the curve ends above
/// that F: infinity, at F = 0.
struct ShapeMinimum {
  double ratio = 0;
  double finer = 0;     ///< F
  double diameter = 0;  ///< m
  double finer_limit = 0;
};
ShapeMinimum minimum_shape_ratio(const Grading& grading, const StabilityLimits& limits = {});

/// Supremum over all splits from F = `from_finer` on of D15 of the coarse over d85 of the fine fraction,
/// exact for the curve. Its ends are candidates as well: F towards 1, where D15 of what is left as the coarse
/// part tends to the largest grain, and the smallest F of which both sizes are known, `from_finer` or, on a
/// curve that ends above 0, its end's share/0.85. A ratio of 0 where no split has both sizes (more than 85 %
/// unknown). Throws UserError unless 0 <= from_finer < 1.
struct SplitMaximum {
  double ratio = 0;
  double finer = 0;  ///< split at this F; at a gap, and at F = 1, the value is the one just beside it
};
SplitMaximum maximum_split_ratio(const Grading& grading, double from_finer = 0);

CriterionResult usace(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult istomina(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult lubochkov(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult kezdi(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult sherard(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult kenney_lau(const Grading& grading, const StabilityLimits& limits = {});
/// Kezdi's criterion as the least secant slope of the curve per log cycle, from the smallest grain on.
CriterionResult chapuis_kezdi(const Grading& grading, const StabilityLimits& limits = {});
/// Kenney and Lau's as the least of that slope over F/log10 4.
CriterionResult chapuis_kenney_lau(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult burenkova(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult honjo(const Grading& grading, const StabilityLimits& limits = {});
CriterionResult liu(const Grading& grading, const StabilityLimits& limits = {});
/// From F = 0, the smallest grain, to Kenney and Lau's limit.
CriterionResult li_fannin(const Grading& grading, const StabilityLimits& limits = {});
/// Wan and Fell's logistic form of Burenkova's factors, for silt-sand-gravel.
CriterionResult wan_fell_probability(const Grading& grading, const StabilityLimits& limits = {});
/// Wan and Fell's slopes of the coarse and the fine part.
CriterionResult wan_fell_slopes(const Grading& grading, const StabilityLimits& limits = {});

/// All of the above, in the thesis's order. A criterion that needs a size below the end of the curve does not
/// apply, and says where the curve ends; one that searches the curve looks at what is known of it: unstable
/// there is unstable, stable there only counts where at most `unknown_fines` lie below.
std::vector<CriterionResult> grading_criteria(const Grading& grading, const StabilityLimits& limits = {});

}  // namespace suffuse::micromechanics
