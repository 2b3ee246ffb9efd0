#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse grading PSD`: sizes, C_u, C_c, gap, and every criterion on the grading.
void add_grading(CLI::App& app);

}  // namespace suffuse::analysis
