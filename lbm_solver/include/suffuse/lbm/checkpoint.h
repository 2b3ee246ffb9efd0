#pragma once

#include <string>

#include "suffuse/lbm/fluid.h"

namespace suffuse::lbm {

/// Writes the whole state of a fluid (populations as stored, solid labels, step count) to an HDF5 file, so
/// that a run that loads it goes on bit for bit as if it had never stopped, on any number of ranks. The file
/// appears under its name only when it is complete. Collective.
void save_state(const Fluid& fluid, const std::string& path);

/// Puts a saved state into a fluid of the same size and storage type; its faces, collision and force are the
/// caller's. A UserError if the file is of another size or storage type. Collective.
void load_state(Fluid& fluid, const std::string& path);

}  // namespace suffuse::lbm
