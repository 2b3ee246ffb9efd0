#pragma once

#include <array>
#include <span>
#include <vector>

#include "grading/sphere_grid.h"
#include "suffuse/common/linear_algebra.h"

namespace suffuse::analysis {

/// A box of grains. Along a direction that is not periodic, what lies on the hull of the grains is left out.
struct SphereBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< m
  std::array<bool, 3> periodic{true, true, true};
};

/// A constriction: the largest disc that passes through a face between two pores.
struct Constriction {
  Vec3 centre = Vec3::Zero();  ///< m
  Vec3 normal = Vec3::Zero();  ///< unit, across the face
  double diameter = 0;         ///< m
};

struct PackingConstrictions {
  std::vector<Constriction> constrictions;  ///< of one period of the box
  std::vector<double> pore_diameters;       ///< largest void sphere of each pore, m
  std::size_t cells = 0;                    ///< tetrahedra of the box
  std::size_t closed =
      0;  ///< faces in which no free disc has its centre: grains overlap, or one stands in the way
};

/// Constrictions of an actual packing (keys: reboul2010, shireosullivan2016): regular (weighted Delaunay)
/// triangulation of the grains with weights radius²; a void sphere in each tetrahedron, tangent to its four
/// grains and cut back where a fifth intrudes; tetrahedra whose void spheres overlap by more than
/// `merge_overlap` of the smaller one's diameter are one pore; in each face left between two pores the
/// largest disc in its plane that touches three of the grains there, intruding ones included. A disc that
/// several faces share counts once.
///
/// `merge_overlap`: 0 merges at any overlap, 1 only where one sphere holds the other. Periodic images are
/// made as far as 1.5 of the largest grain, further where void spheres are larger. Throws UserError on fewer
/// than four grains, radii that are not positive, a box too small, or grains outside it along a periodic
/// direction.
PackingConstrictions packing_constrictions(std::span<const Sphere> grains, const SphereBox& box,
                                           double merge_overlap = 0.5);

}  // namespace suffuse::analysis
