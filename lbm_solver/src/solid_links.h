#pragma once

#include <map>
#include <vector>

#include "populations.h"
#include "suffuse/lbm/decomposition.h"

namespace suffuse::lbm {

/// Half-way bounce-back off whole solid cells, and the momentum that it hands to them.
///
/// Solid cells carry labels 1 to 255; the force is kept for each label. Populations less their weights enter,
/// so that a closed body feels the gauge pressure (above density one), as it should; on a body that touches a
/// face of the box the reference pressure of the missing side is not counted either.
template <class T>
class SolidLinks {
 public:
  /// `labels` must hold the ghost cells' labels as well. Links that leave the box by a wall, velocity or
  /// pressure face belong to that face.
  SolidLinks(const Decomposition& decomposition, const FaceConditions& faces,
             const Populations<T>& populations, const CellLabels& labels);

  void fill(Populations<T>& populations);
  void fold(Populations<T>& populations);

  bool empty() const { return groups_.empty(); }

  /// Force of the last step on this rank's solid cells with a label, lattice units.
  Vec3 force(std::uint8_t label) const;

 private:
  struct Group {
    int direction = 0;
    std::uint8_t label = 0;
    std::vector<std::ptrdiff_t> cells;
  };
  std::vector<Group> groups_;
  std::map<std::uint8_t, Vec3> forces_;
};

}  // namespace suffuse::lbm
