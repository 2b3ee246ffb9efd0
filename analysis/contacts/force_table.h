#pragma once

#include <cstdint>

#include "files/record_table.h"
#include "suffuse/micromechanics/force_distribution.h"

namespace suffuse::analysis {

/// The force distribution of a snapshot as rows of CSV, a row a bin.
void write_force_pdf(CsvWriter& writer, std::int64_t step, const micromechanics::ForceBins& bins,
                     const micromechanics::ForceDistribution& forces);

}  // namespace suffuse::analysis
