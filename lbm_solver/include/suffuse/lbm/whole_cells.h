#pragma once

#include <string>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/index3.h"

namespace suffuse::lbm {

/// Number of cells of edge `spacing` along each axis of a box, both in m; a size may miss a whole number by a
/// thousandth of a cell. A UserError of `who` that names the nearest spacing that fits all three axes, or the
/// nearest size that fits the spacing, if the box is not a whole number of cells.
Index3 whole_cells(const Vec3& size, double spacing, const std::string& who);

}  // namespace suffuse::lbm
