#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse verdict [PSD] [--sample FILES...]`: one report on the internal stability of a soil.
void add_verdict(CLI::App& app);

}  // namespace suffuse::analysis
