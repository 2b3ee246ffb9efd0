#pragma once

#include <CLI/CLI.hpp>

namespace suffuse::analysis {

void add_shear(CLI::App& app);

}  // namespace suffuse::analysis
