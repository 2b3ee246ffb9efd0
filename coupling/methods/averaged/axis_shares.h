#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace suffuse::coupling::averaged {

/// Shares of a grain at one position along one axis of `cells` cells.
///
/// Cells get a quadratic spline (reach 1.5 cells), faces across the axis a linear one. The derivative of the
/// first by the position is the difference of the second between a cell's faces: what a moving grain takes
/// from one cell and gives to the next is what its flux carries through the face between them, to the last
/// digit. At ends that are not periodic, shares beyond go to the mirror image inside: they always add up to
/// 1.
struct AxisShares {
  std::array<int, 3> cell{};
  std::array<double, 3> cell_share{};
  std::array<int, 2> face{};
  std::array<double, 2> face_share{};
};

/// `position` in cells above the low end, in [0, cells]. Periodic axes have `cells` faces, others one more.
inline AxisShares axis_shares(double position, int cells, bool periodic) {
  AxisShares shares;
  const int home = std::clamp(static_cast<int>(std::floor(position)), 0, cells - 1);
  const double f = position - home, t = f - 0.5;
  shares.cell_share = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  for (int k = 0; k < 3; ++k) {
    const int at = home + k - 1;
    const int inside = std::clamp(at, 0, cells - 1);
    shares.cell[static_cast<std::size_t>(k)] = periodic ? (at + cells) % cells : inside;
  }
  shares.face = {home, periodic ? (home + 1) % cells : home + 1};
  shares.face_share = {1 - f, f};
  return shares;
}

}  // namespace suffuse::coupling::averaged
