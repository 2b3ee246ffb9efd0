#pragma once

#include <CLI/CLI.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse lifting`: the least velocity of fluidisation from a record of pressure drop over
/// velocity.
void add_lifting(CLI::App& app);

}  // namespace suffuse::analysis
