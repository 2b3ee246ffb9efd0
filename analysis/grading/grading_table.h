#pragma once

#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/internal_stability.h"

namespace suffuse::analysis {

/// The cumulative curve as CSV.
void write_curve(SafeFile& file, const micromechanics::Grading& grading);

/// Kenney and Lau's shape curve as CSV: all of it, and up to which F it was searched.
void write_shape(SafeFile& file, const micromechanics::Grading& grading,
                 const micromechanics::StabilityLimits& limits);

}  // namespace suffuse::analysis
