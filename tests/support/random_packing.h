#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::coupling {

/// Spheres to be placed at random in a box from (0,0,0) to `box`. Lengths in any one unit.
struct PackingRequest {
  Vec3 box = Vec3::Ones();
  std::array<bool, 3> periodic{true, true, true};  ///< else a wall at both ends
  std::vector<double> radii;
  std::uint64_t seed = 1;
};

/// Centres of the spheres, in the order of `radii`: none overlaps another (or its image) or a wall. From
/// random places the spheres grow from nothing to their size while overlapping ones are pushed apart, and are
/// then shaken as hard spheres; the same request gives the same packing. Equal spheres come as dense as 0.62.
/// Throws std::runtime_error where they find no place.
std::vector<Vec3> random_packing(const PackingRequest& request);

/// Smallest gap between two spheres (or a sphere and a wall), over the smaller radius; negative where they
/// overlap.
double smallest_gap(const PackingRequest& request, const std::vector<Vec3>& centres);

/// Diameter of the sphere with the surface per volume of all of them together.
double sauter_diameter(const std::vector<double>& radii);

/// Sum of their volumes.
double volume_of(const std::vector<double>& radii);

/// So many radii with the mean 1, evenly spread from 1 - spread to 1 + spread, in a fixed mixed order.
std::vector<double> spread_radii(int count, double spread);

/// The grading of the thesis's Appendix C (20 classes of equal mass): as many spheres of each class as make
/// the masses equal with one of the largest. Radii over the Sauter mean radius.
std::vector<double> appendix_c_radii();

/// So many radii of a grading file (rows diameter, share of the mass; input_scripts/gradings), at equal steps
/// of the number of grains that are smaller, over the largest class's. Throws std::runtime_error without the
/// file.
std::vector<double> grading_radii(const std::string& path, int count);

/// Coarse spheres of radius 1 and enough finer ones, `ratio` times smaller, to make up a share of the volume.
std::vector<double> gap_graded_radii(int coarse, double ratio, double fines_share);

}  // namespace suffuse::coupling
