#pragma once

#include <array>
#include <cstddef>

namespace suffuse::lbm {

/// A cell, or a number of cells along x, y and z.
using Index3 = std::array<int, 3>;

/// Cells lo <= c < hi along each axis.
struct CellBox {
  Index3 lo{0, 0, 0};
  Index3 hi{0, 0, 0};

  constexpr int extent(int axis) const {
    return hi[static_cast<std::size_t>(axis)] - lo[static_cast<std::size_t>(axis)];
  }
  constexpr Index3 extents() const { return {extent(0), extent(1), extent(2)}; }
  constexpr bool empty() const { return extent(0) <= 0 || extent(1) <= 0 || extent(2) <= 0; }
  constexpr std::size_t volume() const {
    return empty() ? 0
                   : static_cast<std::size_t>(extent(0)) * static_cast<std::size_t>(extent(1)) *
                         static_cast<std::size_t>(extent(2));
  }
  constexpr bool operator==(const CellBox&) const = default;
};

/// Calls body(x, y, z) for every cell of the box, x fastest.
template <class Body>
void for_each_cell(const CellBox& box, Body&& body) {
  for (int z = box.lo[2]; z < box.hi[2]; ++z)
    for (int y = box.lo[1]; y < box.hi[1]; ++y)
      for (int x = box.lo[0]; x < box.hi[0]; ++x) body(x, y, z);
}

}  // namespace suffuse::lbm
