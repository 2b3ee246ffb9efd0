#pragma once

#include <array>
#include <cstddef>

#include "suffuse/lbm/index3.h"

namespace suffuse::coupling::averaged {

using lbm::Index3;

/// Numbers of the cells of a box and of the faces between them. Face `at` of axis a lies on the low side of
/// cell `at`; axes that are not periodic have one more, on the box's high side.
class StaggeredGrid {
 public:
  StaggeredGrid(const Index3& cells, const std::array<bool, 3>& periodic)
      : cells_(cells), periodic_(periodic) {}

  const Index3& cells() const { return cells_; }
  bool periodic(std::size_t axis) const { return periodic_[axis]; }
  int extent(std::size_t face_axis, std::size_t along) const {
    return cells_[along] + (face_axis == along && !periodic_[along] ? 1 : 0);
  }

  std::size_t cell_count() const { return product(cells_[0], cells_[1], cells_[2]); }
  std::size_t face_count(std::size_t axis) const {
    return product(extent(axis, 0), extent(axis, 1), extent(axis, 2));
  }
  std::size_t cell(const Index3& at) const { return at_in(at, cells_[0], cells_[1]); }
  std::size_t face(std::size_t axis, const Index3& at) const {
    return at_in(at, extent(axis, 0), extent(axis, 1));
  }

  /// -1: on the box's low side, +1: on its high side, 0: between cells.
  int side(std::size_t axis, const Index3& at) const {
    if (periodic_[axis]) return 0;
    return at[axis] == 0 ? -1 : at[axis] == cells_[axis] ? 1 : 0;
  }

  /// The cells below and above a face; on a side of the box the one that is there stands for both.
  std::array<Index3, 2> cells_beside(std::size_t axis, const Index3& at) const {
    Index3 low = at, high = at;
    const int n = cells_[axis];
    low[axis] = periodic_[axis] ? (at[axis] + n - 1) % n : at[axis] - 1;
    const int s = side(axis, at);
    if (s < 0) low = high;
    if (s > 0) high = low;
    return {low, high};
  }
  /// The faces of a cell across an axis.
  std::array<Index3, 2> faces_of(std::size_t axis, const Index3& at) const {
    Index3 high = at;
    high[axis] = periodic_[axis] ? (at[axis] + 1) % cells_[axis] : at[axis] + 1;
    return {at, high};
  }

  template <class Visit>
  void for_each_face(std::size_t axis, const Visit& visit) const {
    std::size_t n = 0;
    for (int z = 0; z < extent(axis, 2); ++z)
      for (int y = 0; y < extent(axis, 1); ++y)
        for (int x = 0; x < extent(axis, 0); ++x) visit(Index3{x, y, z}, n++);
  }

 private:
  static std::size_t product(int a, int b, int c) {
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
  }
  static std::size_t at_in(const Index3& at, int nx, int ny) {
    return static_cast<std::size_t>(at[0]) +
           static_cast<std::size_t>(nx) * (static_cast<std::size_t>(at[1]) +
                                           static_cast<std::size_t>(ny) * static_cast<std::size_t>(at[2]));
  }

  Index3 cells_;
  std::array<bool, 3> periodic_;
};

}  // namespace suffuse::coupling::averaged
