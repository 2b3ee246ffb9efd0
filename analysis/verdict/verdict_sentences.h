#pragma once

#include <string>
#include <vector>

#include "verdict/verdict_findings.h"

namespace suffuse::analysis {

/// One sentence: what the thesis's own measure, the best of those at hand, says of the soil.
std::string headline(const VerdictInput& input, const VerdictFindings& findings);
/// How many criteria say what, and which groups are of one mind.
std::vector<std::string> agreement_sentences(const VerdictFindings& findings);
/// Which are not, and why that may be.
std::vector<std::string> disagreement_sentences(const VerdictInput& input, const VerdictFindings& findings);

/// A measured number with four digits; "-" where there is none.
std::string measured_text(const Record& record, const char* name);

}  // namespace suffuse::analysis
