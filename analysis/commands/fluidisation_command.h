#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse fluidisation FLOW.csv`: porosity, conductivity and critical gradients of an upward-flow
/// run from its monitor file, beside what formulas say.
void add_fluidisation(CLI::App& app);

}  // namespace suffuse::analysis
