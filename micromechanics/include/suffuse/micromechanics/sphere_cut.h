#pragma once

#include "suffuse/common/linear_algebra.h"

namespace suffuse::micromechanics {

/// Volume of the part of a sphere (radius r, centre at 0) with coordinate below `height`, m³: π(r + h)²(2r −
/// h)/3 for −r ≤ h ≤ r, 0 below and the whole sphere above.
double sphere_volume_below(double radius, double height);

/// An axis-aligned box; a side may be infinite.
struct Box {
  Vec3 low = Vec3::Zero();   ///< m
  Vec3 high = Vec3::Zero();  ///< m
};

/// Volume of the part of a sphere inside a box, m³. Exact (spherical segments) where the box cuts it along
/// one axis only; where it cuts along two or three, the area of circle and rectangle is integrated along the
/// third axis by Gauss's rule between the points where its form changes: relative error below 1e-9.
double sphere_volume_in_box(const Vec3& centre, double radius, const Box& box);

}  // namespace suffuse::micromechanics
