#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/walls.h"

namespace suffuse::lbm {

/// Surfaces at rest, in cells from the low corner of the box; all without thickness and without end unless
/// said.
struct PlaneWall {
  int axis = 2;  ///< that it is normal to
  double position = 0;
};
struct CylinderWall {
  int axis = 2;
  double radius = 0;
  Vec3 centre = Vec3::Zero();  ///< the component along the axis is not used
};
/// Triangles, each with its edges; those that share an edge leave no gap.
struct MeshWall {
  std::vector<std::array<Vec3, 3>> triangles;
};
using WallShape = std::variant<PlaneWall, CylinderWall, MeshWall>;

struct WallCuts {
  std::vector<WallLink> links;  ///< of this rank's cells; spaces are not known yet
  /// How many links (counted at both ends, on all ranks) each shape cuts; 0: it lies outside, on a face, or
  /// between no two centres of cells.
  std::vector<std::int64_t> count;
};

/// A plane, or a triangle of a mesh, nearer than this to a face of the box (cells) is taken to lie on it;
/// what happens there is the face's business. Periodic sides are no faces.
inline constexpr double kOnFace = 5e-3;

/// The links between cells' centres that surfaces cut, each at the surface nearest to its end.
///
/// Planes and cylinders cut a link if one end is on each side; a centre that lies on the surface counts to
/// the upper side of a plane, the outer of a cylinder. So is a triangle, within its edges and a millionth of
/// a cell. Links through periodic faces see the shapes on both sides; those that a free-slip face mirrors are
/// followed to where they end. In front of no-slip and velocity faces what is nearer acts, surface or face.
/// Collective.
WallCuts cut_links(const Decomposition& decomposition, const FaceConditions& faces,
                   const std::vector<WallShape>& shapes);

}  // namespace suffuse::lbm
