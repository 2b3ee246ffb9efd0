#pragma once

#include <cstdint>
#include <vector>

#include "suffuse/lbm/index3.h"

namespace suffuse::lbm {

/// One end of a link that a wall at rest cuts: what leaves `cell` in `direction` comes back. The other end,
/// if it is a cell, needs an entry of its own.
struct WallLink {
  Index3 cell{0, 0, 0};   ///< of this rank, numbered over the whole box
  int direction = 0;      ///< 1 to 18
  double distance = 0.5;  ///< of the wall from the cell's centre, as a share of the link: 0 to 1
  int space = -1;         ///< which of `Walls::spaces` the cell lies in; -1: one whose mass nobody counts
};

/// Walls of no thickness between cells of a rank, and the cells behind them.
///
/// Populations come back by the linear interpolation of Bouzidi et al. (docs key: bouzidi2001): walls at half
/// of the link are the half-way bounce-back, exact for a wall there; elsewhere of second order in the cell.
/// The interpolation alone neither keeps the mass: what it adds in a step to one space is taken back from all
/// links of that space, in proportion to their weights. So each space keeps its mass to round-off of the
/// storage type, whatever the number of ranks.
struct Walls {
  std::vector<WallLink> links;
  /// Spaces between the walls of all ranks, by number; the same on every rank.
  int spaces = 0;
  /// One value a cell of this rank, x fastest: 1 where there is no water. Empty: nowhere. Links that lead
  /// from a cell with water to such a cell must be cut; what enters such cells through them does not matter.
  std::vector<std::uint8_t> closed;

  bool empty() const { return links.empty() && closed.empty(); }
};

}  // namespace suffuse::lbm
