#include "suffuse/micromechanics/sample_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suffuse::micromechanics {
namespace {

constexpr double kSameLength = 0.02;

}  // namespace

GrainExtent::GrainExtent()
    : low(Vec3::Constant(std::numeric_limits<double>::infinity())),
      high(Vec3::Constant(-std::numeric_limits<double>::infinity())) {}

void GrainExtent::add(const Vec3& centre, double radius) {
  low = low.cwiseMin(centre - Vec3::Constant(radius));
  high = high.cwiseMax(centre + Vec3::Constant(radius));
  largest_diameter = std::max(largest_diameter, 2 * radius);
}

GrainExtent grain_extent(const Packing& packing) {
  GrainExtent extent;
  for (const Grain& grain : packing.grains) extent.add(grain.position, grain.radius);
  return extent;
}

Box bed_box(const GrainExtent& grains, const Box& simulation_box, const std::array<bool, 3>& periodic) {
  Box bed = simulation_box;
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = grains.high[axis] - grains.low[axis];
    const double length = simulation_box.high[axis] - simulation_box.low[axis];
    const bool filled = periodic[static_cast<std::size_t>(axis)] && length - reach < grains.largest_diameter;
    if (filled || !(reach > 0)) continue;
    bed.low[axis] = grains.low[axis];
    bed.high[axis] = grains.high[axis];
  }
  return bed;
}

bool is_another_sample(const Box& taken, const Box& bed, const std::array<bool, 3>& axes) {
  for (int axis = 0; axis < 3; ++axis) {
    const double length = bed.high[axis] - bed.low[axis];
    if (axes[static_cast<std::size_t>(axis)] &&
        std::abs(taken.high[axis] - taken.low[axis] - length) > kSameLength * length)
      return true;
  }
  return false;
}

double volume_of(const Box& box) {
  return (box.high - box.low).prod();
}

Packing part_inside(const Packing& packing, const std::function<bool(const Vec3& centre)>& is_inside) {
  Packing part;
  part.volume = packing.volume;
  part.box_low = packing.box_low;
  part.box_high = packing.box_high;
  std::vector<int> place(packing.grains.size(), kNotOwned);
  for (std::size_t g = 0; g < packing.grains.size(); ++g) {
    if (!is_inside(packing.grains[g].position)) continue;
    place[g] = static_cast<int>(part.grains.size());
    part.grains.push_back(packing.grains[g]);
  }
  const auto place_of = [&](int grain) { return place[static_cast<std::size_t>(grain)]; };
  for (Contact contact : packing.contacts) {
    const Grain first = first_grain(packing, contact);
    contact.first = place_of(contact.first);
    if (!owns_second(contact)) {
      if (contact.first == kNotOwned) continue;
      Image image = image_of(packing, contact);
      if (!is_inside(first.position - contact.branch)) image.listing = Listing::own_half;
      add_image_contact(part, contact, image);
      continue;
    }
    const Grain second = packing.grains[static_cast<std::size_t>(contact.second)];
    contact.second = place_of(contact.second);
    if (contact.first != kNotOwned && contact.second != kNotOwned) {
      part.contacts.push_back(contact);
    } else if (contact.first != kNotOwned) {
      add_image_contact(part, contact, {second.id, second.radius, Listing::own_half});
    } else if (contact.second != kNotOwned) {
      contact.first = contact.second;
      contact.branch = -contact.branch;
      contact.force = -contact.force;
      add_image_contact(part, contact, {first.id, first.radius, Listing::own_half});
    }
  }
  for (WallContact wall : packing.walls) {
    wall.grain = place_of(wall.grain);
    if (wall.grain != kNotOwned) part.walls.push_back(wall);
  }
  return part;
}

}  // namespace suffuse::micromechanics
