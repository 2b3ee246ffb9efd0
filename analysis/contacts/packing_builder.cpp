#include "contacts/packing_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

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

namespace {

using micromechanics::Contact;
using micromechanics::Packing;

constexpr double kSameBranch = 1e-6;    // of the sum of the radii
constexpr double kDeflateLimit = 1032;  // bytes that one byte can stand for

bool is_whole_period(const Vec3& branch, const Vec3& period, double reach) {
  if (branch.norm() < kNearest * reach) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double periods = period[axis] > 0 ? std::round(branch[axis] / period[axis]) : 0;
    if (std::abs(branch[axis] - periods * period[axis]) > kSameBranch * reach) return false;
  }
  return true;
}

std::uint64_t pair_key(const Contact& contact) {
  const auto low = static_cast<std::uint64_t>(std::min(contact.first, contact.second));
  const auto high = static_cast<std::uint64_t>(std::max(contact.first, contact.second));
  return low << 32 | high;
}

/// Are two contacts of one pair the same, seen from either grain?
bool is_same(const Packing& packing, const Contact& a, const Contact& b) {
  const double sign = a.first == b.first ? 1 : -1;
  const double reach = first_grain(packing, a).radius + second_radius(packing, a);
  if (a.first == a.second)  // an image: either of its two sides
    return std::min((a.branch - b.branch).norm(), (a.branch + b.branch).norm()) < kSameBranch * reach;
  return (a.branch - sign * b.branch).norm() < kSameBranch * reach;
}

/// Keys of pairs that are listed more than once; they alone are looked at more closely.
std::vector<std::uint64_t> repeated_pairs(const Packing& packing) {
  std::vector<std::uint64_t> keys, repeated;
  keys.reserve(packing.contacts.size());
  for (const Contact& contact : packing.contacts) keys.push_back(pair_key(contact));
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (keys[k] == keys[k - 1] && (repeated.empty() || repeated.back() != keys[k]))
      repeated.push_back(keys[k]);
  return repeated;
}

}  // namespace

std::string problem_of_contacts(const Packing& packing, const Vec3& period) {
  const auto told = [&](const Contact& contact) {
    return fmt::format("the contact of grains {} and {}", first_grain(packing, contact).id,
                       second_id(packing, contact));
  };
  for (const Contact& contact : packing.contacts) {
    if (contact.friction < 0 || contact.friction_limit < 0 || contact.spring_force < 0)
      return told(contact) + " has a negative friction";
    const double reach = first_grain(packing, contact).radius + second_radius(packing, contact);
    if (contact.first == contact.second && !is_whole_period(contact.branch, period, reach))
      return fmt::format("grain {} is in contact with itself", first_grain(packing, contact).id);
  }
  const std::vector<std::uint64_t> repeated = repeated_pairs(packing);
  if (repeated.empty()) return {};
  std::map<std::uint64_t, std::vector<const Contact*>> of_pair;
  for (const Contact& contact : packing.contacts)
    if (const auto key = pair_key(contact); std::binary_search(repeated.begin(), repeated.end(), key)) {
      std::vector<const Contact*>& known = of_pair[key];
      for (const Contact* other : known)
        if (is_same(packing, contact, *other)) return told(contact) + " is there twice";
      known.push_back(&contact);
    }
  return {};
}

std::size_t plausible_rows(std::int64_t claimed, std::int64_t bytes, std::size_t columns, bool compressed,
                           std::size_t least) {
  const double most = static_cast<double>(bytes) * (compressed ? kDeflateLimit : 1) /
                      static_cast<double>(std::max<std::size_t>(columns, 1) * least);
  return static_cast<std::size_t>(std::min(static_cast<double>(claimed), most));
}

std::optional<std::int64_t> identifier(double value) {
  if (!(value >= 1 && value <= 9007199254740992.0) || value != std::floor(value)) return std::nullopt;
  return static_cast<std::int64_t>(value);
}

}  // namespace suffuse::analysis
