#pragma once

#include <vector>

#include "populations.h"
#include "suffuse/lbm/boundary.h"
#include "suffuse/lbm/decomposition.h"

namespace suffuse::lbm {

/// Values that face rules need besides the populations, in lattice units.
struct FaceContext {
  Vec3 force = Vec3::Zero();
  bool incompressible = false;
};

/// The rules that send a population back into the cell it left (walls, velocity and pressure faces), for the
/// faces of the whole box that this rank holds. Edges and corners follow link_rule().
///
/// A link of cell x in direction i leads out of the box. Its two places are (x + c_i, slot i), where an odd
/// step puts what leaves and looks for what enters, and (x, slot opposite(i)), where an even step does.
template <class T>
class FacePatches {
 public:
  FacePatches(const Decomposition& decomposition, const FaceConditions& faces);

  /// After an even step: puts what enters where the odd step will look for it.
  void fill(Populations<T>& populations, const FaceConditions& faces, const FaceContext& context);
  /// After an odd step: puts what enters where the even step will look for it.
  void fold(Populations<T>& populations, const FaceConditions& faces, const FaceContext& context);

 private:
  /// Cells whose link in one direction leaves the box by the same face or edge.
  struct Patch {
    int direction = 0;
    CellBox cells;
    LinkRule rule;
  };
  /// Density and velocity of a face's cells after their collision, in the order of for_each_cell.
  struct FaceMoments {
    CellBox cells;
    std::vector<double> density, velocity[3];
  };

  template <bool kOddStep>
  void apply(Populations<T>& populations, const FaceConditions& faces, const FaceContext& context);
  template <bool kOddStep>
  void read_moments(const Populations<T>& populations, const FaceContext& context,
                    FaceMoments& moments) const;

  std::vector<Patch> patches_;
  std::array<FaceMoments, kFaces> moments_;
};

}  // namespace suffuse::lbm
