#pragma once

#include <vector>

#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/walls.h"

namespace suffuse::lbm {

/// Finds the spaces that cut links divide the box into: cells that links lead from one to another lie in one
/// space. Those in which at least one of the `wet` cells lies hold water, the others are closed; without any
/// wet cell on any rank all hold water.
///
/// `wet` are cells of any rank, numbered over the whole box; those outside it are not looked at. Links that
/// lead from closed cells out of the box are added to `links`: nothing comes in there. Collective.
Walls divide(const Decomposition& decomposition, const FaceConditions& faces, std::vector<WallLink> links,
             const std::vector<Index3>& wet);

/// The same with cells that are known to be closed (one value a cell of this rank, x fastest; see
/// Walls::closed).
Walls divide(const Decomposition& decomposition, const FaceConditions& faces, std::vector<WallLink> links,
             const std::vector<std::uint8_t>& closed);

}  // namespace suffuse::lbm
