#pragma once

#include <string>
#include <vector>

#include "suffuse/micromechanics/grading.h"

namespace suffuse::analysis {

/// Reads a particle size distribution from a CSV file (csv_file.h: quotes, semicolons, byte-order marks;
/// decimal_mark.h: decimal commas, thousands), its columns by name (sieve_columns.h), others ignored.
/// Amounts:
/// - `percent_finer` and the like: the curve, ending at 100 (within 0.5 %) at the coarsest size; where its
/// finest
///   size is above 0 the curve ends there (Grading::unknown_below);
/// - retained on sieves: each size is a sieve, the row `pan` (or size 0) what passed all; a mass needs that
/// row,
///   and the coarsest sieve retains nothing;
/// - `mass_fraction` (adding to 1 within 0.1 %), `mass_kg`: grains of these sizes; with a pan: retained.
/// Masses at
///   the openings of four or more sieves and nothing else are refused: either may be meant.
/// Sizes sorted either way; at least two.
///
/// Throws UserError (`who` first, then the file and line) on anything else.
micromechanics::Grading read_grading(const std::string& path, const std::string& who,
                                     const micromechanics::GapRule& rule = {});

/// Whether a file is a dump of LIGGGHTS rather than a CSV file, by its first line.
bool is_dump(const std::string& path, const std::string& who);

}  // namespace suffuse::analysis
