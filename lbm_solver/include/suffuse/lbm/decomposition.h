#pragma once

#include <mpi.h>

#include <array>
#include <functional>
#include <vector>

#include "suffuse/lbm/boundary.h"
#include "suffuse/lbm/index3.h"

namespace suffuse::lbm {

/// How a box of cells is divided among ranks: a grid of ranks whose planes lie at any cells, so that
/// sub-boxes may be of unequal size (LIGGGHTS's own sub-boxes, snapped to cells). Every rank holds at least
/// one cell.
class Decomposition {
 public:
  /// Cuts along each axis: cuts[axis] = {0, ..., cells}, strictly rising; rank (i,j,k) of the grid owns the
  /// cells between its cuts. `rank_at(i,j,k)` is its rank in `communicator`, whose size is the number of grid
  /// places. A UserError if the cuts do not rise (a rank without cells) or the sizes disagree.
  static Decomposition from_cuts(MPI_Comm communicator, std::array<std::vector<int>, 3> cuts,
                                 const std::function<int(const Index3&)>& rank_at);

  /// Sub-boxes as equal as they can be, cut first across z, then y, then x (rows along x stay long), with the
  /// smallest surface among the divisions of the rank count. `rank_grid` fixes ranks along axes where it is >
  /// 0.
  static Decomposition balanced(MPI_Comm communicator, const Index3& cells,
                                const Index3& rank_grid = {0, 0, 0});

  MPI_Comm communicator() const { return communicator_; }
  const Index3& cells() const { return cells_; }
  const Index3& rank_grid() const { return rank_grid_; }

  /// The cells of this rank, in the numbering of the whole box.
  const CellBox& local_box() const { return local_; }

  /// Is this face of the local box a part of the whole box's face?
  bool at_global_face(Face face) const;

  /// The rank beyond a face, across the periodic boundary at the end of the grid (then perhaps this rank
  /// itself).
  int neighbour(Face face) const { return neighbours_[static_cast<std::size_t>(face)]; }

  int rank() const { return rank_; }
  int ranks() const { return rank_grid_[0] * rank_grid_[1] * rank_grid_[2]; }

 private:
  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0;
  Index3 cells_{}, rank_grid_{};
  CellBox local_;
  std::array<int, kFaces> neighbours_{};
};

}  // namespace suffuse::lbm
