#pragma once

#include <string>
#include <vector>

#include "verdict/report_document.h"
#include "verdict/verdict_findings.h"

namespace suffuse::analysis {

/// A drawn figure and the one command that draws it again from its CSV files.
struct VerdictFigure {
  enum class Of { grading, shape, boundaries, forces, rose, flow, layers };
  Of of = Of::grading;
  std::string file;  ///< its name without an ending
  std::string svg, meaning, caption, command;
};

/// Writes the CSV files into `folder` (which exists), draws from them, as SVG for the page and, with `png`,
/// as PNG beside it. Throws UserError where there is no Python with matplotlib.
std::vector<VerdictFigure> draw_verdict_figures(const VerdictInput& input, const VerdictFindings& findings,
                                                const micromechanics::Packing* packing,
                                                const std::string& folder, bool png);

}  // namespace suffuse::analysis
