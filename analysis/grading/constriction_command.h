#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse constriction [PSD] [--packing DUMP]`: constriction sizes from a grading and from an
/// actual packing, and the criteria on them.
void add_constriction(CLI::App& app);

}  // namespace suffuse::analysis
