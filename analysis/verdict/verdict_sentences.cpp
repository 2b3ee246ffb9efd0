#include "verdict/verdict_sentences.h"

#include <fmt/format.h>

#include <algorithm>

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

/// Whether the splits part, at one of the densities.
bool hangs_on_split(const VerdictFindings& findings) {
  return std::any_of(findings.splits.begin(), findings.splits.end(), [&](const SplitFinding& one) {
    const SplitFinding& first = findings.splits.front();
    return one.loosest.verdict != first.loosest.verdict ||
           (one.densest && one.densest->verdict != first.densest->verdict);
  });
}

/// "1.87 (unstable) cut at 25 % (at the gap), 0.42 (stable) cut at 20 % (chapter 4, dense)".
std::string split_list(const VerdictFindings& findings) {
  std::string text;
  for (const SplitFinding& one : findings.splits) {
    const std::string dense = one.densest ? fmt::format(" loosest and {:.3g} ({}) densest",
                                                        one.densest->value, to_string(one.densest->verdict))
                                          : std::string();
    text += fmt::format("{}{:.3g} ({}){}, cut at {:.3g} % ({})", text.empty() ? "" : "; ", one.loosest.value,
                        to_string(one.loosest.verdict), dense, 100 * one.split.finer, one.split.rule);
  }
  return text;
}

/// "Indraratna 2007 (filter)": commas are for lists.
std::string in_list(const std::string& criterion) {
  const std::size_t comma = criterion.find(", ");
  if (comma == std::string::npos) return criterion;
  return fmt::format("{} ({})", criterion.substr(0, comma), criterion.substr(comma + 2));
}

std::string named(const CriteriaGroup& group, Verdict verdict) {
  std::string text;
  for (const CriterionResult& result : group.results)
    if (result.verdict == verdict)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", in_list(result.criterion));
  return text;
}

/// "stable by Kezdi, Sherard; unstable by Chapuis (Kezdi's slope)": of one group.
std::string division(const CriteriaGroup& group) {
  std::string text;
  for (const Verdict verdict : kVerdicts)
    if (const std::string names = named(group, verdict); !names.empty())
      text += fmt::format("{}{} by {}", text.empty() ? "" : "; ", to_string(verdict), names);
  return text;
}

/// What most of some criteria say; none on a tie.
std::optional<Verdict> leaning(const std::vector<CriterionResult>& results) {
  std::size_t stable = 0, unstable = 0;
  for (const CriterionResult& result : results) {
    stable += result.verdict == Verdict::stable ? 1 : 0;
    unstable += result.verdict == Verdict::unstable ? 1 : 0;
  }
  if (stable == unstable) return std::nullopt;
  return stable > unstable ? Verdict::stable : Verdict::unstable;
}

void add_density_sentence(const VerdictFindings& findings, std::vector<std::string>& sentences) {
  for (const CriterionResult& loose : findings.constriction) {
    const CriterionResult* dense = find(findings.constriction_densest, loose.criterion);
    if (dense == nullptr || dense->verdict == loose.verdict) continue;
    sentences.push_back(fmt::format(
        "{} depends on the density, which is not given: {} in the loosest state ({:.3g}), {} in "
        "the densest ({:.3g}).",
        loose.criterion, to_string(loose.verdict), loose.value, to_string(dense->verdict), dense->value));
  }
}

void add_sample_sentences(const VerdictInput& input, const VerdictFindings& findings,
                          std::vector<std::string>& sentences) {
  const Record& record = findings.sample->record;
  const auto z = value_of(record, "coordination_number"), halves = value_of(record, "alpha_pair_halves"),
             point = value_of(record, "alpha_contact_point"),
             fc = value_of(record, "coordination_fine_coarse");
  if (!z || !halves || !point || !fc) return;
  const ConstrictionLimits& limits = input.constriction_limits;
  const MicroscaleLimits at{limits.coordination, limits.stress_reduction};
  if (findings.measured[0].verdict != findings.measured[1].verdict)
    sentences.push_back(fmt::format(
        "The thesis words its boundary of Z and alpha in two ways, and here they differ: where either "
        "low number makes it unstable the sample is {}, where it takes both {}.",
        to_string(findings.measured[0].verdict), to_string(findings.measured[1].verdict)));
  if ((*halves <= at.stress_reduction) != (*point <= at.stress_reduction))
    sentences.push_back(fmt::format(
        "The two definitions of alpha fall on different sides of {:g}: {:.3g} by pair halves, with "
        "which the limit was drawn, {:.3g} by contact point.",
        at.stress_reduction, *halves, *point));
  if (findings.analysis) {
    const Verdict predicted = microscale_verdict(
        findings.analysis->coordination, findings.analysis->stress_reduction, BoundaryWording::either, at);
    if (predicted != findings.measured[0].verdict)
      sentences.push_back(
          fmt::format("The fits to the constriction sizes predict Z = {:.3g} and alpha = {:.3g}, {}; the "
                      "sample has {:.3g} and {:.3g}, {}. "
                      "The measured numbers count.",
                      findings.analysis->coordination, findings.analysis->stress_reduction,
                      to_string(predicted), *z, *halves, to_string(findings.measured[0].verdict)));
  }
  const auto fines = value_of(record, "fines_solid_share");
  if (!fines || !input.grading.gap()) return;
  const FinesZone zone = fines_zone(*fines);
  const FabricCase fabric = fabric_case(*fc, *halves, at);
  const bool contradict = (zone == FinesZone::underfilled && fabric == FabricCase::overfilled) ||
                          (zone == FinesZone::overfilled && fabric != FabricCase::overfilled);
  if (contradict)
    sentences.push_back(
        fmt::format("{:.3g} % of fines would be {} by Shire's zones, but the sample's fabric is case {}: {}.",
                    100 * *fines, to_string(zone), to_string(fabric), description(fabric)));
}

std::string headline_of_sample(const VerdictInput& input, const VerdictFindings& findings) {
  const Record& record = findings.sample->record;
  const std::string numbers =
      fmt::format("{} contacts a grain (Z), fines under {} of the mean stress (alpha)",
                  measured_text(record, "coordination_number"), measured_text(record, "alpha_pair_halves"));
  const char* where = findings.sample->at_rest ? "measured on the sample at rest" : "measured on the sample";
  const ConstrictionLimits& limits = input.constriction_limits;
  if (findings.measured[0].verdict != findings.measured[1].verdict)
    return fmt::format(
        "Between stable and unstable, {}: {}. One of the two is beyond its limit ({:g} and {:g}), the "
        "other is not.",
        where, numbers, limits.coordination, limits.stress_reduction);
  return fmt::format("Internally {}, {}: {}. The limits are {:g} and {:g}.",
                     to_string(findings.measured[0].verdict), where, numbers, limits.coordination,
                     limits.stress_reduction);
}

std::string headline_of_grading(const VerdictInput& input, const VerdictFindings& findings) {
  const double limit = input.constriction_limits.chapter_4;
  constexpr const char* kRatio = "the pores' controlling constriction over the larger fine grains (Dc35/d85)";
  if (hangs_on_split(findings))
    return fmt::format(
        "It depends on the split, where the grading is cut into coarse and fine part: {} is {}; unstable "
        "from {:g}.",
        kRatio, split_list(findings), limit);
  if (const CriterionResult* at = find(findings.constriction, kChapter4)) {
    const CriterionResult* dense = find(findings.constriction_densest, at->criterion);
    if (dense != nullptr && dense->verdict != at->verdict)
      return fmt::format(
          "It depends on the density: {} is {:.3g} in the loosest state ({}), {:.3g} in the densest ({}); "
          "unstable from {:g}.",
          kRatio, at->value, to_string(at->verdict), dense->value, to_string(dense->verdict), limit);
    return fmt::format(
        "Internally {}: {} is {:.3g}{}; unstable from {:g}.", to_string(at->verdict), kRatio, at->value,
        dense != nullptr ? fmt::format(" in the loosest, {:.3g} in the densest state", dense->value) : "",
        limit);
  }
  const std::optional<Verdict> most = leaning(findings.grading);
  return fmt::format("{}: only criteria on grain sizes apply, and they do not know the density.",
                     most ? fmt::format("Most criteria say {}", to_string(*most)) : "Undecided");
}

}  // namespace

std::string headline(const VerdictInput& input, const VerdictFindings& findings) {
  if (!findings.measured.empty()) return headline_of_sample(input, findings);
  return headline_of_grading(input, findings) + (findings.sample
                                                     ? " The sample was measured, but has no alpha with this "
                                                       "split between fines and coarse grains: see --split."
                                                     : " No sample was measured.");
}

std::vector<std::string> agreement_sentences(const VerdictFindings& findings) {
  std::size_t stable = 0, transitional = 0, unstable = 0, other = 0;
  for (const CriteriaGroup& group : findings.groups) {
    stable += group.count(Verdict::stable);
    transitional += group.count(Verdict::transitional);
    unstable += group.count(Verdict::unstable);
    other += group.count(Verdict::not_applicable);
  }
  std::vector<std::string> sentences{
      fmt::format("{} criteria apply: stable {}, transitional {}, unstable {}; {} do not apply. Many look at "
                  "the same thing, "
                  "so this is no vote.",
                  stable + transitional + unstable, stable, transitional, unstable, other)};
  for (const Verdict verdict : kVerdicts) {
    std::string names;
    for (const CriteriaGroup& group : findings.groups)
      if (group.common() == verdict) names += (names.empty() ? "" : "; ") + group.name;
    if (!names.empty()) sentences.push_back(fmt::format("Agreed on {}: {}.", to_string(verdict), names));
  }
  return sentences;
}

std::vector<std::string> disagreement_sentences(const VerdictInput& input, const VerdictFindings& findings) {
  std::vector<std::string> sentences;
  for (const CriteriaGroup& group : findings.groups) {
    const bool applies = group.count(Verdict::not_applicable) < group.results.size();
    if (applies && !group.common() && group.name != kMeasuredGroup)
      sentences.push_back(fmt::format("Divided on {}: {}. Why: {}.", group.name, division(group), group.why));
  }
  const std::optional<Verdict> by_sizes = leaning(findings.grading),
                               by_pores = leaning(findings.constriction);
  if (by_sizes && by_pores && *by_sizes != *by_pores)
    sentences.push_back(
        fmt::format("Most criteria on grain sizes say {}, most on constrictions {}: grain sizes alone do not "
                    "know how densely "
                    "the grains are packed. In chapter 4 the constriction criterion followed Z and alpha, "
                    "the others scattered.",
                    to_string(*by_sizes), to_string(*by_pores)));
  add_density_sentence(findings, sentences);
  if (hangs_on_split(findings))
    sentences.push_back(
        fmt::format("Chapter 4's constriction criterion hangs on the split: {}. The table has the split "
                    "of chapter 4 at this density.",
                    split_list(findings)));
  if (!findings.measured.empty()) {
    const std::optional<Verdict> lean = by_pores ? by_pores : by_sizes;
    const Verdict measured = findings.measured[0].verdict;
    if (lean && *lean != measured)
      sentences.push_back(
          fmt::format("The sample is {} by Z and alpha (either is low), most criteria on {} say {}.",
                      to_string(measured), by_pores ? "constrictions" : "grain sizes", to_string(*lean)));
    add_sample_sentences(input, findings, sentences);
  }
  if (sentences.empty()) {
    const std::vector<std::string> agreed = agreement_sentences(findings);
    sentences.emplace_back(agreed.size() > 2
                               ? "Whole groups differ, as told above; within each all are of one mind."
                               : "None: all groups of criteria are of one mind.");
  }
  return sentences;
}

std::string measured_text(const Record& record, const char* name) {
  const std::optional<double> value = value_of(record, name);
  return value ? fmt::format("{:.4g}", *value) : "-";
}

}  // namespace suffuse::analysis
