#pragma once

#include "suffuse/common/hdf5_file.h"
#include "suffuse/lbm/decomposition.h"

namespace suffuse::lbm {

/// This rank's cells in an array (z, y, x) of the whole box.
ArrayPart cells_of(const Decomposition& decomposition);

}  // namespace suffuse::lbm
