#include "verdict/verdict_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/internal_stability.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

/// The groups and why the criteria in one may differ, in the order of the report.
struct GroupWords {
  CriterionGroup group;
  const char *name, *why;
};
constexpr GroupWords kGroups[] = {
    {CriterionGroup::sizes_of_parts, "sizes of both parts of the grading",
     "Sherard allows 5 where Kezdi allows 4, and Chapuis reads Kezdi's criterion from the slope alone"},
    {CriterionGroup::shape_of_curve, "shape of the curve",
     "Lubochkov looks at neighbouring parts of the curve and is sharp at any gap; Li and Fannin take the "
     "stricter of two lines"},
    {CriterionGroup::one_number, "gap, fines, uniformity",
     "each knows one number: Istomina d60/d10, Honjo the gap, Liu the fines content"},
    {CriterionGroup::size_ratios, "ratios of coarse and fine sizes",
     "they were drawn from tests on broadly graded soils, each in its own way"},
    {CriterionGroup::constrictions, "constriction sizes",
     "Kovacs's mean pore follows from the porosity, the others look at the discs between grains, with "
     "limits from 0.73 to 1 "
     "and at different densities"},
    {CriterionGroup::predicted, "Z and alpha, predicted", "both are fits that scatter"}};

std::vector<CriteriaGroup> grouped(const VerdictFindings& findings) {
  std::vector<CriteriaGroup> groups;
  for (const GroupWords& group : kGroups) {
    CriteriaGroup one{group.name, {}, group.why};
    for (const auto* results : {&findings.grading, &findings.constriction})
      for (const CriterionResult& result : *results)
        if (result.group == group.group) one.results.push_back(result);
    if (!one.results.empty()) groups.push_back(std::move(one));
  }
  if (!findings.measured.empty()) groups.push_back({kMeasuredGroup, findings.measured, ""});
  return groups;
}

/// Chapter 4's boundary on what was measured, in both wordings, with alpha by the thesis's own definition.
std::vector<CriterionResult> boundary_on(const Record& record, const ConstrictionLimits& limits) {
  const auto z = value_of(record, "coordination_number"), alpha = value_of(record, "alpha_pair_halves");
  if (!z || !alpha) return {};
  const MicroscaleLimits at{limits.coordination, limits.stress_reduction};
  const auto result = [&](const char* name, const char* word, BoundaryWording wording) {
    return CriterionResult{
        name,
        "Z; alpha by pair halves is " + fmt::format("{:.4g}", *alpha),
        *z,
        fmt::format("unstable: Z <= {:g} {} alpha <= {:g}", at.coordination, word, at.stress_reduction),
        microscale_verdict(*z, *alpha, wording, at),
        "haq",
        ""};
  };
  return {result("Z or alpha low", "or", BoundaryWording::either),
          result("Z and alpha low", "and", BoundaryWording::both)};
}

std::vector<HydraulicInput::Alpha> alphas(const VerdictInput& input, const VerdictFindings& findings) {
  std::vector<HydraulicInput::Alpha> all;
  if (input.alpha) all.push_back({*input.alpha, "given"});
  if (findings.sample) {
    if (const auto halves = value_of(findings.sample->record, "alpha_pair_halves"))
      all.push_back({*halves, "the sample, pair halves"});
    if (const auto point = value_of(findings.sample->record, "alpha_contact_point"))
      all.push_back({*point, "the sample, contact point"});
  }
  if (all.empty() && findings.analysis)
    all.push_back({findings.analysis->stress_reduction, "predicted by a fit"});
  return all;
}

/// Chapter 4's criterion with every split that the sources allow.
std::vector<SplitFinding> by_split(const VerdictInput& input) {
  const std::vector<GradingSplit> splits =
      allowed_splits(input.grading, input.constriction_limits, input.limits);
  if (input.constriction.split || splits.size() < 2) return {};
  std::vector<SplitFinding> found;
  for (const GradingSplit& split : splits) {
    ConstrictionOptions options = input.constriction;
    options.split = split.finer;
    const auto at = [&](double density) {
      options.relative_density = density;
      return *find(constriction_criteria(
                       analyse_constrictions(input.grading, options, input.constriction_limits, input.limits),
                       options, input.constriction_limits),
                   kChapter4);
    };
    SplitFinding one{split, at(input.relative_density.value_or(0)), std::nullopt};
    if (!input.relative_density) one.densest = at(1);
    found.push_back(std::move(one));
  }
  return found;
}

/// The criteria on constrictions, or why there are none: a grading of one size cannot be cut.
void add_constrictions(const VerdictInput& input, VerdictFindings& findings) {
  try {
    ConstrictionOptions options = input.constriction;
    options.relative_density = input.relative_density.value_or(0);
    options.porosity = input.porosity;
    findings.analysis =
        analyse_constrictions(input.grading, options, input.constriction_limits, input.limits);
    findings.constriction = constriction_criteria(*findings.analysis, options, input.constriction_limits);
    findings.splits = by_split(input);
    if (input.relative_density) return;
    options.relative_density = 1;
    findings.constriction_densest = constriction_criteria(
        analyse_constrictions(input.grading, options, input.constriction_limits, input.limits), options,
        input.constriction_limits);
  } catch (const UserError& problem) {
    if (input.constriction.split) throw;  // the user's own number
    findings.analysis.reset();
    findings.constriction.clear();
    findings.no_constrictions = problem.what();
  }
}

}  // namespace

const CriterionResult* find(const std::vector<CriterionResult>& results, std::string_view name) {
  const auto at = std::find_if(results.begin(), results.end(),
                               [&](const CriterionResult& result) { return result.criterion == name; });
  return at == results.end() ? nullptr : &*at;
}

std::size_t CriteriaGroup::count(Verdict verdict) const {
  return static_cast<std::size_t>(
      std::count_if(results.begin(), results.end(),
                    [&](const CriterionResult& result) { return result.verdict == verdict; }));
}

std::optional<Verdict> CriteriaGroup::common() const {
  const std::size_t apply = results.size() - count(Verdict::not_applicable);
  for (const Verdict verdict : kVerdicts)
    if (apply > 0 && count(verdict) == apply) return verdict;
  return std::nullopt;
}

VerdictFindings find_verdicts(const VerdictInput& input, std::optional<SampleFindings> sample) {
  VerdictFindings findings;
  findings.sample = std::move(sample);
  findings.grading = grading_criteria(input.grading, input.limits);
  add_constrictions(input, findings);
  if (findings.sample) findings.measured = boundary_on(findings.sample->record, input.constriction_limits);
  if (input.porosity) {
    HydraulicInput hydraulic = input.hydraulic;
    hydraulic.porosity = *input.porosity;
    hydraulic.alphas = alphas(input, findings);
    findings.hydraulic = hydraulic_rows(hydraulic, input.grading);
  }
  findings.groups = grouped(findings);
  return findings;
}

}  // namespace suffuse::analysis
