#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse reproduce table-4-1|table-5-1 FOLDERS...`: what samples measure against the thesis's
/// rows.
void add_reproduce(CLI::App& app);

}  // namespace suffuse::analysis
