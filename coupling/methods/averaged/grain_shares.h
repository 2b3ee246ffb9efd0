#pragma once

#include <array>
#include <vector>

#include "averaged/axis_shares.h"
#include "averaged/staggered_grid.h"
#include "suffuse/common/linear_algebra.h"

namespace suffuse::coupling::averaged {

/// A grain in its cells, SI.
struct PlacedGrain {
  bool wet = false;  ///< its centre lies in the box
  std::array<AxisShares, 3> axes;
  double diameter = 0, volume = 0, mass = 0;
  Vec3 velocity = Vec3::Zero();
  double drag = 0;  ///< z, N s/m
};

/// Visits the 27 cells that a grain has a share in: visit(cell number, share).
template <class Visit>
void for_each_cell_of(const PlacedGrain& grain, const StaggeredGrid& grid, const Visit& visit) {
  const auto& [x, y, z] = grain.axes;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i)
        visit(grid.cell({x.cell[i], y.cell[j], z.cell[k]}),
              x.cell_share[i] * y.cell_share[j] * z.cell_share[k]);
}

/// The same for the 18 faces across an axis.
template <class Visit>
void for_each_face_of(const PlacedGrain& grain, std::size_t axis, const StaggeredGrid& grid,
                      const Visit& visit) {
  const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
  const AxisShares &along = grain.axes[axis], &first = grain.axes[b], &second = grain.axes[c];
  Index3 at{};
  for (std::size_t n = 0; n < 2; ++n)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) {
        at[axis] = along.face[n];
        at[b] = first.cell[i];
        at[c] = second.cell[j];
        visit(grid.face(axis, at), along.face_share[n] * first.cell_share[i] * second.cell_share[j]);
      }
}

}  // namespace suffuse::coupling::averaged
