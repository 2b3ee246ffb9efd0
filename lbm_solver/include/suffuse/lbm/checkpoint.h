#pragma once

#include <string>

#include "suffuse/lbm/fluid.h"
#include "suffuse/lbm/units.h"

namespace suffuse::lbm {

/// Writes the whole state of a fluid (populations as stored, solid labels, step count) to an HDF5 file, so
/// that a run that loads it goes on bit for bit as if it had never stopped, on any number of ranks. The file
/// appears under its name only when it is complete. `units`: its spacing and time step are kept with it.
/// Collective.
void save_state(const Fluid& fluid, const std::string& path, const Units* units = nullptr);

/// Puts a saved state into a fluid of the same size and storage type; its faces, collision and force are the
/// caller's. A UserError if the file is of another size or storage type, or of another spacing or time step
/// than `units`: its velocities and times would become others. Collective.
void load_state(Fluid& fluid, const std::string& path, const Units* units = nullptr);

}  // namespace suffuse::lbm
