#include "suffuse/lbm/decomposition.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "suffuse/common/error.h"

namespace suffuse::lbm {

namespace {

std::vector<int> equal_cuts(int cells, int parts) {
  std::vector<int> cuts(static_cast<std::size_t>(parts) + 1);
  for (int i = 0; i <= parts; ++i)
    cuts[static_cast<std::size_t>(i)] = static_cast<int>(static_cast<long long>(cells) * i / parts);
  return cuts;
}

void check_cuts(const std::array<std::vector<int>, 3>& cuts) {
  static const char* const names[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<int>& c = cuts[axis];
    const bool rises = c.size() >= 2 && c.front() == 0 &&
                       std::adjacent_find(c.begin(), c.end(), [](int a, int b) { return a >= b; }) == c.end();
    if (!rises)
      throw_user_error({"fluid lattice", std::string("cuts between ranks along ") + names[axis],
                        fmt::format("{}", fmt::join(c, " ")), "rise from 0, one cell a rank at least",
                        "fewer ranks along this axis"});
  }
}

/// The rank grid with the smallest total cut surface; on a tie the one with fewer cuts across x, then y.
Index3 best_grid(int ranks, const Index3& cells, const Index3& fixed) {
  Index3 best{0, 0, 0};
  double best_cost = std::numeric_limits<double>::infinity();
  for (int px = 1; px <= ranks; ++px)
    for (int py = 1; py <= ranks / px; ++py) {
      if (ranks % (px * py) != 0) continue;
      const Index3 grid{px, py, ranks / (px * py)};
      bool fits = true;
      for (std::size_t a = 0; a < 3; ++a)
        fits &= (fixed[a] <= 0 || fixed[a] == grid[a]) && grid[a] <= cells[a];
      if (!fits) continue;
      const double nx = cells[0], ny = cells[1], nz = cells[2];
      const double cost = (grid[0] - 1) * ny * nz + (grid[1] - 1) * nx * nz + (grid[2] - 1) * nx * ny;
      if (cost < best_cost) {
        best_cost = cost;
        best = grid;
      }
    }
  return best;
}

}  // namespace

Decomposition Decomposition::from_cuts(MPI_Comm communicator, std::array<std::vector<int>, 3> cuts,
                                       const std::function<int(const Index3&)>& rank_at) {
  check_cuts(cuts);
  Decomposition d;
  d.communicator_ = communicator;
  MPI_Comm_rank(communicator, &d.rank_);
  int size = 0;
  MPI_Comm_size(communicator, &size);
  for (std::size_t a = 0; a < 3; ++a) {
    d.cells_[a] = cuts[a].back();
    d.rank_grid_[a] = static_cast<int>(cuts[a].size()) - 1;
  }
  if (d.ranks() != size)
    throw_user_error({"fluid lattice", "rank grid", fmt::format("{}", fmt::join(d.rank_grid_, "x")),
                      fmt::format("hold {} ranks", size), ""});
  Index3 coordinates{};
  for_each_cell({{0, 0, 0}, d.rank_grid_}, [&](int i, int j, int k) {
    if (rank_at({i, j, k}) == d.rank_) coordinates = {i, j, k};
  });
  for (std::size_t a = 0; a < 3; ++a) {
    const auto place = static_cast<std::size_t>(coordinates[a]);
    d.local_.lo[a] = cuts[a][place];
    d.local_.hi[a] = cuts[a][place + 1];
    for (int side = 0; side < 2; ++side) {
      Index3 there = coordinates;
      there[a] = (there[a] + (side == 1 ? 1 : d.rank_grid_[a] - 1)) % d.rank_grid_[a];
      d.neighbours_[2 * a + static_cast<std::size_t>(side)] = rank_at(there);
    }
  }
  return d;
}

Decomposition Decomposition::balanced(MPI_Comm communicator, const Index3& cells, const Index3& rank_grid) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  static const char* const names[] = {"x", "y", "z"};
  for (std::size_t a = 0; a < 3; ++a)
    if (cells[a] < 1)
      throw_user_error({"fluid lattice", std::string("cells along ") + names[a], fmt::format("{}", cells[a]),
                        "be at least 1", "a smaller spacing or a larger box"});
  const Index3 grid = best_grid(ranks, cells, rank_grid);
  if (grid[0] == 0)
    throw_user_error({"fluid lattice", "ranks", fmt::format("{}", ranks),
                      fmt::format("divide {} cells into boxes of at least one cell", fmt::join(cells, "x")),
                      "another number of ranks"});
  return from_cuts(
      communicator,
      {equal_cuts(cells[0], grid[0]), equal_cuts(cells[1], grid[1]), equal_cuts(cells[2], grid[2])},
      [&](const Index3& c) { return c[0] + grid[0] * (c[1] + grid[1] * c[2]); });
}

bool Decomposition::at_global_face(Face face) const {
  const auto axis = static_cast<std::size_t>(axis_of(face));
  return is_high(face) ? local_.hi[axis] == cells_[axis] : local_.lo[axis] == 0;
}

}  // namespace suffuse::lbm
