#include "suffuse/analysis/packing_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suffuse/micromechanics/coordination.h"

namespace suffuse::analysis {
namespace {

/// Centres further apart than this share of the radii's sum are no contact, nor any bridge of water: other
/// units or wrong columns.
constexpr double kFarthest = 1.5;
constexpr double kNearest = 0.3;

/// How far the parts of a force may miss their sum: six digits each, with room for their signs.
constexpr double kRoundedSum = 1e-4;

/// A normal force lies along the branch, to the rounding of positions; a whole force within a cone of
/// friction.
constexpr double kAlong = 0.999;
constexpr double kWithinFriction = 0.7;

double alignment(const Vec3& branch, const Vec3& force) {
  return std::abs(branch.dot(force)) / (branch.norm() * force.norm());
}

/// The branch to the nearest image of the second grain. In a box that is not many grains wide another image
/// may be the one that touches: then the force tells which, as the only one that it is along.
Vec3 branch_of(const RawContact& raw, double reach, const Vec3& period) {
  Vec3 nearest = *raw.separation;
  for (int axis = 0; axis < 3; ++axis)
    if (period[axis] > 0) nearest[axis] -= period[axis] * std::round(nearest[axis] / period[axis]);
  const Vec3& force = raw.normal_force ? *raw.normal_force : *raw.force;
  const double enough = raw.normal_force ? kAlong : kWithinFriction;
  if (force.norm() == 0 || period.norm() == 0 || alignment(nearest, force) > enough) return nearest;
  Vec3 best = nearest;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vec3 image = nearest + Vec3(x, y, z).cwiseProduct(period);
        if (image.norm() < kFarthest * reach && alignment(image, force) > alignment(best, force))
          best = image;
      }
  return best;
}

}  // namespace

std::string set_branch_and_force(const RawContact& raw, double reach, const Vec3& period, bool rounded,
                                 micromechanics::Contact& contact) {
  Vec3 branch = branch_of(raw, reach, period);
  const double distance = branch.norm();
  if (distance > kFarthest * reach || distance < kNearest * reach)
    return fmt::format("its centres are {:.3g} m apart and the radii add up to {:.3g} m", distance, reach);
  contact.force = raw.force ? *raw.force : Vec3(*raw.normal_force + *raw.tangential_force);
  if (raw.normal_force && raw.normal_force->norm() > 0) {
    const Vec3 direction = raw.normal_force->normalized();
    const double along = direction.dot(branch) / distance;
    if (std::abs(along) < 0.9) return "its normal force is not along the line between the centres";
    if (rounded) branch = std::copysign(distance, along) * direction;
    if (raw.tangential_force) {
      const Vec3 sum = *raw.normal_force + *raw.tangential_force;
      if ((sum - contact.force).norm() > kRoundedSum * (sum.norm() + contact.force.norm()))
        return "its normal and tangential forces do not add up to its force";
      if (rounded) contact.force = sum;
    }
  }
  if (rounded && raw.overlap) branch *= (reach - *raw.overlap) / branch.norm();
  contact.branch = branch;
  return {};
}

std::string problem_of_grains(const micromechanics::Packing& packing) {
  if (packing.grains.empty()) return "there are no grains";
  const Vec3 box = packing.box_high - packing.box_low;
  double solids = 0;
  for (const micromechanics::Grain& grain : packing.grains) {
    if (!(grain.radius > 0)) return fmt::format("grain {} has the radius {:.4g} m", grain.id, grain.radius);
    if (2 * grain.radius > box.maxCoeff())
      return fmt::format("grain {} with the radius {:.4g} m is larger than the box ({:.4g} m): units differ",
                         grain.id, grain.radius, box.maxCoeff());
    solids += micromechanics::sphere_volume(grain.radius);
  }
  if (solids > packing.volume)
    return fmt::format(
        "the grains have {:.4g} m³, the sample {:.4g} m³: units differ, or the volume is wrong (of a "
        "shrink-wrapped box: say --bed)",
        solids, packing.volume);
  return {};
}

}  // namespace suffuse::analysis
