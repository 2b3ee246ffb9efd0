#pragma once

#include <map>
#include <optional>
#include <string>

#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/constriction_criteria.h"

namespace suffuse::analysis {

/// Words of the options --fractions and --loose-pore.
const std::map<std::string, micromechanics::FractionBy>& fraction_names();
const std::map<std::string, micromechanics::LoosePore>& pore_names();

/// Constriction sizes as CSV over the shares 0, 1, … 100 %: those of the analysis by all three fractions (m),
/// and those of a packing beside them. Either may be missing.
void write_distribution(SafeFile& file, const micromechanics::ConstrictionOptions& options,
                        const std::optional<micromechanics::ConstrictionAnalysis>& analysis,
                        const std::optional<micromechanics::SizeDistribution>& packing = std::nullopt);

/// D_c35/d85 and Z and α by eqs 4.7 and 4.8 as CSV over the whole range of relative density.
void write_prediction(SafeFile& file, const micromechanics::Grading& grading,
                      micromechanics::ConstrictionOptions options,
                      const micromechanics::ConstrictionLimits& limits,
                      const micromechanics::StabilityLimits& stability);

}  // namespace suffuse::analysis
