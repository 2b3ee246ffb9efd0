#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/constriction_criteria.h"
#include "suffuse/micromechanics/internal_stability.h"

namespace suffuse::analysis {

/// Criteria as a table for the screen, notes in lines of their own below.
std::string criteria_text(const std::vector<micromechanics::CriterionResult>& results);

/// Criteria as CSV: criterion, measure, value, limit, verdict, source, note. An empty value where a criterion
/// does not apply.
void write_criteria(SafeFile& file, const std::vector<micromechanics::CriterionResult>& results);

/// Sets limits from words `name=value`: of the criteria on the grading, and of those on constrictions where
/// given. Throws UserError on an unknown name (with the known ones) or no number.
void set_limits(const std::vector<std::string>& words, const std::string& who,
                micromechanics::StabilityLimits& limits,
                micromechanics::ConstrictionLimits* constriction = nullptr);

/// A grading from a CSV file or from the grains of a dump (its last snapshot).
micromechanics::Grading grading_of_file(const std::string& path, const std::string& who);

/// Sizes, C_u, C_c and the gap in a few lines.
std::string grading_text(const micromechanics::Grading& grading);

}  // namespace suffuse::analysis
