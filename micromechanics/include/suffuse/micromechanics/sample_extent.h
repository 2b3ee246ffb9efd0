#pragma once

#include <array>
#include <functional>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sphere_cut.h"

namespace suffuse::micromechanics {

/// What the surfaces of grains reach, m; low > high without grains.
struct GrainExtent {
  Vec3 low;
  Vec3 high;
  double largest_diameter = 0;

  GrainExtent();
  void add(const Vec3& centre, double radius);
};

GrainExtent grain_extent(const Packing& packing);

/// The bed as a convex body: the smallest upright box that holds the grains; along a periodic axis that they
/// fill but for less than a largest diameter it is the simulation box's own length. Without grains: the
/// simulation box.
Box bed_box(const GrainExtent& grains, const Box& simulation_box, const std::array<bool, 3>& periodic);

/// Does `taken` have another length than the bed along one of these axes, by more than 2 % of it? Overlaps
/// with walls are less.
bool is_another_sample(const Box& taken, const Box& bed,
                       const std::array<bool, 3>& axes = {true, true, true});

/// m³.
double volume_of(const Box& box);

/// Grains whose centre `is_inside`, whole, with all of their contacts: of one with a grain outside, what is
/// theirs counts (Listing::own_half), so that coordination numbers and stresses over the body's volume are
/// those of the packing it is cut from. The volume and the box stay.
Packing part_inside(const Packing& packing, const std::function<bool(const Vec3& centre)>& is_inside);

}  // namespace suffuse::micromechanics
