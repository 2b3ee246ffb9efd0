#pragma once

#include <CLI/CLI.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse suffusion`: at which gradients fines left a sample, from the monitor of scene 09.
void add_suffusion(CLI::App& app);

}  // namespace suffuse::analysis
