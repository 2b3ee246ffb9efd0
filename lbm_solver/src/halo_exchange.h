#pragma once

#include <array>
#include <vector>

#include "populations.h"
#include "suffuse/lbm/decomposition.h"

namespace suffuse::lbm {

/// Carries the populations that cross the faces between sub-boxes, periodic ends and planes of symmetry.
///
/// With the AA pattern an odd step reads from and writes to neighbour cells. `fill` copies what the outermost
/// cells will read into the ghost cells before an odd step; `fold` takes what they wrote into ghost cells
/// back to the cells it belongs to after it. Only the five directions that cross a face travel. Axes go one
/// after the other (x, y, z; folding in reverse) and each takes the ghost cells of the former along, so that
/// populations crossing an edge arrive without messages of their own. Ghost cells beyond pressure faces have
/// been filled before and go along too.
template <class T>
class HaloExchange {
 public:
  HaloExchange(const Decomposition& decomposition, const FaceConditions& faces);

  void fill(Populations<T>& populations);
  void fold(Populations<T>& populations);

 private:
  enum class Partner { none, self, other, mirror };

  void run_axis(Populations<T>& populations, int axis, bool folding);
  void mirror(Populations<T>& populations, int axis, bool high, bool folding);
  void exchange(Populations<T>& populations, int axis, bool folding);

  CellBox layer(const Index3& cells, int axis, int position) const;

  MPI_Comm communicator_;
  std::array<Partner, kFaces> partners_{};
  std::array<int, kFaces> neighbours_{};
  std::array<bool, kFaces> pressure_{};
  std::vector<T> send_[2], receive_[2];
};

}  // namespace suffuse::lbm
