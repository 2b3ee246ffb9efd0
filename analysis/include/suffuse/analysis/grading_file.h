#pragma once

#include <string>
#include <vector>

#include "suffuse/micromechanics/grading.h"

namespace suffuse::analysis {

/// Reads a particle size distribution from a CSV file: one row of names, then numbers; lines that begin with
/// # are left out. Columns by name, others ignored: `diameter_m` or `diameter_mm` (or `radius_m`), and one of
/// `mass_fraction` (adding to 1 within 0.1 %), `mass_kg`, `percent_finer` (cumulative, ending at 100). Sizes
/// sorted either way; at least two.
///
/// Throws UserError (`who` first, then the file and line) on anything else.
micromechanics::Grading read_grading(const std::string& path, const std::string& who,
                                     const micromechanics::GapRule& rule = {});

/// Whether a file is a dump of LIGGGHTS rather than a CSV file, by its first line.
bool is_dump(const std::string& path, const std::string& who);

}  // namespace suffuse::analysis
