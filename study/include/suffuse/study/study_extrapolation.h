#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "suffuse/study/grid_convergence.h"
#include "suffuse/study/study_file.h"

namespace suffuse::study {

struct StudyRow;

/// Runs that differ in their resolution alone, and what no spacing would give.
struct StudyExtrapolation {
  std::vector<std::size_t> rows;               ///< all of them, in the table's order
  std::vector<std::size_t> used;               ///< of these, the finest first
  std::string resolutions;                     ///< of those used: "8 5 3"
  std::vector<GridConvergence> of_quantities;  ///< in the study's order
};

/// The groups of runs that have finished, in the table's order; none where the study asks for none.
std::vector<StudyExtrapolation> extrapolations(const Study& study, const std::vector<StudyRow>& rows);

/// Names of the columns of study.csv, and their cells in a row: the extrapolated value of each quantity, its
/// bar, the observed order and how it converges, then the resolutions used. Empty where none is asked for.
std::string extrapolation_titles(const Study& study);
std::string extrapolation_cells(const Study& study, const std::vector<StudyExtrapolation>& groups,
                                std::size_t row);

/// "1.158 ± 0.019 (order 1.4)" or "no value: oscillates".
std::string to_text(const GridConvergence& convergence);

}  // namespace suffuse::study
