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

/// What enters through the faces of the whole box that this rank holds, other than by streaming and
/// mirrors. Edges and corners follow link_rule().
///
/// Pressure faces (`extend`): the ghost cell beyond face cell y holds y's populations, shifted by the
/// equilibrium of the density difference, f*_j(ghost) = f*_j(y) + feq_j(2 rho_face - rho_y, u_y) -
/// feq_j(rho_y, u_y): the density is linear across the face, velocity and stress are those of y. Plain
/// anti-bounce-back drops the shear stress at the face and bends the pressure over a width of the channel
/// (docs/decisions/fluid-pressure-faces.md).
///
/// Walls and velocities (`fill`, `fold`): bounce-back, f_opposite = f_i - 6 w_i rho c_i . u. A cell of a
/// velocity face lets in what its straight link (a third) and its four diagonal ones (a sixth each) push.
/// Along the edge with a wall one of these belongs to the wall, along that with another velocity face half of
/// one is the other's: the straight link makes up for it, so that a face lets in its area times its velocity,
/// whatever its sides are.
///
/// Such a link of cell x in direction i leads out of the box. Its two places are (x + c_i, slot i), where an
/// odd step puts what leaves and looks for what enters, and (x, slot opposite(i)), where an even step does.
template <class T>
class FacePatches {
 public:
  FacePatches(const Decomposition& decomposition, const FaceConditions& faces);

  /// Density and velocity of the cells at velocity and pressure faces, straight after a collision; first of
  /// all.
  void read_moments(const Populations<T>& populations, const FaceConditions& faces,
                    const FaceContext& context, bool after_odd_step);

  /// Pressure faces, before the halo exchange.
  void extend_fill(Populations<T>& populations, const FaceConditions& faces,
                   const FaceContext& context) const;
  void extend_fold(Populations<T>& populations, const FaceConditions& faces,
                   const FaceContext& context) const;

  /// No-slip walls across x touch one cell of each row, a cache line at a time: swept by themselves they cost
  /// a sixth of a step. Their inner part (no edge of the sub-box, so nothing that the exchange writes) is
  /// done in rows begin_y <= y < end_y of a plane as soon as the kernel has been there, while the lines are
  /// still in the cache.
  bool has_near_rows() const { return !near_patches_.empty(); }
  void apply_near_rows(Populations<T>& populations, bool after_odd_step, int begin_y, int end_y, int z) const;

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
  void read_moments_of(FaceMoments& moments, const Populations<T>& populations,
                       const FaceContext& context) const;
  template <bool kOddStep>
  void extend(Populations<T>& populations, const FaceConditions& faces, const FaceContext& context) const;

  void add(const Patch& patch, const Index3& cells, bool wall_across_x);
  /// u - u of the face that `cell` touches besides the velocity face of the patch, times the share of the
  /// push along the straight link that is missing there; summed over such faces.
  Vec3 missing_velocity(const Patch& patch, const FaceConditions& faces, const Index3& cell) const;

  std::vector<Patch> patches_, near_patches_;
  CellBox whole_;                                  ///< this rank's cells, from its own corner
  std::array<double, kFaces> missing_at_edges_{};  ///< by the face that is met; 0 where it is not this rank's
  std::array<FaceMoments, kFaces> moments_;
};

}  // namespace suffuse::lbm
