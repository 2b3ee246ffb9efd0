#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse hydraulic PSD --porosity n`: critical gradients and conductivities of a soil without a
/// run.
void add_hydraulic(CLI::App& app);

}  // namespace suffuse::analysis
