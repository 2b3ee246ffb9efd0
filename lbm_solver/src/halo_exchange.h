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
///
/// Across x, a periodic end on this rank and a plane of symmetry touch one value of a cache line in each row:
/// swept by themselves they took a fifth of a step in float. `apply_near_rows` does them in rows begin_y <= y
/// < end_y of plane z as soon as the kernel has been there, while the lines are still in the cache; `fill`
/// and `fold` do what is left: what no cell of the sub-box wrote.
template <class T>
class HaloExchange {
 public:
  HaloExchange(const Decomposition& decomposition, const FaceConditions& faces);

  void fill(Populations<T>& populations);
  void fold(Populations<T>& populations);

  bool has_near_rows() const { return is_local(0) || is_local(1); }
  void apply_near_rows(Populations<T>& populations, bool after_odd_step, int begin_y, int end_y, int z) const;

  /// What crosses between ranks along z is complete as soon as the kernel, apply_near_rows included, has been
  /// in the first and the last plane: after an odd step always, after an even one where x and y are not cut
  /// as well (their ghost cells travel along); pressure faces beside the cut forbid both. `start_early` sends
  /// it then, so that a rank waits only for one that is a whole sweep late; `fill` or `fold` receives.
  bool can_start_early(bool after_odd_step) const;
  void start_early(Populations<T>& populations, bool after_odd_step);

 private:
  enum class Partner { none, self, other, mirror };

  /// Buffers of an axis, by the side that the directions leave through. Each axis has its own: those of z may
  /// be under way while the others are exchanged.
  struct Messages {
    std::vector<T> send[2], receive[2];
    MPI_Request requests[4];
    int pending = 0;
  };

  void run_axis(Populations<T>& populations, int axis, bool folding);
  void mirror(Populations<T>& populations, int axis, bool high, bool folding);
  void copy_rows(Populations<T>& populations, int direction, bool folding, const CellBox& rows) const;
  void copy_far_rows(Populations<T>& populations, bool high, bool folding) const;
  void exchange(Populations<T>& populations, int axis, bool folding);
  void post(Populations<T>& populations, int axis, bool folding);
  void finish(Populations<T>& populations, int axis, bool folding);
  void fill_rows_beyond_y(Populations<T>& populations, int z) const;

  bool is_local(std::size_t face) const {
    return partners_[face] == Partner::self || partners_[face] == Partner::mirror;
  }
  CellBox layer(const Index3& cells, int axis, int position) const;
  static CellBox near_rows(const Index3& cells, int direction, bool folding);

  MPI_Comm communicator_;
  std::array<Partner, kFaces> partners_{};
  std::array<int, kFaces> neighbours_{};
  std::array<bool, kFaces> pressure_{};
  std::array<Messages, 3> messages_;
  bool started_ = false;  ///< start_early has been called, its messages are under way
};

}  // namespace suffuse::lbm
