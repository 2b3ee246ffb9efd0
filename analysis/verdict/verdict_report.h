#pragma once

#include <string>
#include <vector>

#include "verdict/report_document.h"
#include "verdict/verdict_figures.h"
#include "verdict/verdict_findings.h"

namespace suffuse::analysis {

/// The whole report. `figure_links`: the folder of the figures as seen from the Markdown page; empty: no
/// links there.
ReportDocument verdict_report(const VerdictInput& input, const VerdictFindings& findings,
                              const std::vector<VerdictFigure>& figures, const std::string& figure_links);

}  // namespace suffuse::analysis
