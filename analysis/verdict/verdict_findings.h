#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contacts/contact_measures.h"
#include "contacts/snapshot.h"
#include "grading/hydraulic_table.h"
#include "suffuse/micromechanics/constriction_criteria.h"
#include "suffuse/micromechanics/microscale_verdicts.h"
#include "verdict/result_rows.h"

namespace suffuse::analysis {

/// What a soil is judged by.
struct VerdictInput {
  std::string name;
  std::string grading_from;  ///< where the grading was read, in words
  micromechanics::Grading grading;
  micromechanics::StabilityLimits limits;
  micromechanics::ConstrictionLimits constriction_limits;
  micromechanics::ConstrictionOptions constriction;
  std::optional<double> relative_density;
  std::optional<double> porosity;
  std::string porosity_from;  ///< in words
  HydraulicInput hydraulic;
  std::optional<double> alpha;  ///< given by the user, for the gradients
  std::string flow;             ///< record of an upward-flow run; empty: none
};

/// A sample's last snapshot, measured.
struct SampleFindings {
  std::int64_t step = 0;
  std::string files;         ///< in words
  bool at_rest = false;      ///< the first snapshot of a run with upward flow, not the last
  std::string split_origin;  ///< why the fines are those that they are
  double split = 0;          ///< m
  double friction = 0;
  Record record;
  micromechanics::ForceDistribution forces;
  micromechanics::ForceBins bins;
};

/// Criteria that look at the same thing.
struct CriteriaGroup {
  std::string name;
  std::vector<micromechanics::CriterionResult> results;
  std::string why;  ///< these may differ among themselves

  std::size_t count(micromechanics::Verdict verdict) const;
  /// The verdict of all that apply; none where they differ or none applies.
  std::optional<micromechanics::Verdict> common() const;
};

/// What chapter 4's constriction criterion says for one of the splits that the sources allow.
struct SplitFinding {
  micromechanics::GradingSplit split;
  micromechanics::CriterionResult loosest;                 ///< or at the relative density, where it is known
  std::optional<micromechanics::CriterionResult> densest;  ///< where it is not
};

struct VerdictFindings {
  std::vector<micromechanics::CriterionResult> grading, constriction;
  /// At the relative density, or in the loosest state where it is not known.
  std::optional<micromechanics::ConstrictionAnalysis> analysis;
  std::vector<micromechanics::CriterionResult> constriction_densest;  ///< where the density is not known
  std::string no_constrictions;                                       ///< why there is no analysis
  std::vector<SplitFinding> splits;  ///< with more than one, none where the user gave the split
  std::optional<SampleFindings> sample;
  std::vector<micromechanics::CriterionResult> measured;  ///< chapter 4's boundary on the sample
  std::vector<HydraulicRow> hydraulic;                    ///< empty without a porosity
  std::vector<CriteriaGroup> groups;
  std::optional<ResultRows> flow;  ///< of the run with upward flow
};

/// Names of the group of what was measured, and of the criterion that the thesis ends with.
inline constexpr const char* kMeasuredGroup = "Z and alpha, measured";
inline constexpr const char* kChapter4 = "Chapter 4 of the thesis";

inline constexpr std::array<micromechanics::Verdict, 3> kVerdicts{micromechanics::Verdict::stable,
                                                                  micromechanics::Verdict::transitional,
                                                                  micromechanics::Verdict::unstable};

/// The result of that criterion; null if there is none.
const micromechanics::CriterionResult* find(const std::vector<micromechanics::CriterionResult>& results,
                                            std::string_view name);

/// Everything but the sample, which is measured before.
VerdictFindings find_verdicts(const VerdictInput& input, std::optional<SampleFindings> sample);

}  // namespace suffuse::analysis
