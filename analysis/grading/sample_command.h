#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse sample PSD`: from a grading to grains for a simulation.
void add_sample(CLI::App& app);

}  // namespace suffuse::analysis
