#include "suffuse/micromechanics/spherical_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace suffuse::micromechanics {
namespace {

using std::numbers::pi;

/// Number of cells of each collar, poles included, from top to bottom; the same read from the bottom.
std::vector<int> cells_of_collars(int wanted) {
  const double side = std::sqrt(4 * pi / wanted);             // of a square cell
  const double cap = 2 * std::asin(std::sqrt(1.0 / wanted));  // polar angle of a cap of one cell's area
  const int collars = std::max(1, static_cast<int>(std::lround((pi - 2 * cap) / side)));
  std::vector<int> counts{1};
  for (int c = 0; c < collars; ++c) {
    const double top = cap + (pi - 2 * cap) * c / collars, bottom = cap + (pi - 2 * cap) * (c + 1) / collars;
    counts.push_back(
        std::max(3, static_cast<int>(std::lround((std::cos(top) - std::cos(bottom)) / 2 * wanted))));
  }
  for (std::size_t c = 1; c < counts.size(); ++c)  // opposite collars alike
    counts[c] = counts[std::min(c, static_cast<std::size_t>(collars) + 1 - c)];
  counts.push_back(1);
  return counts;
}

}  // namespace

SphericalGrid::SphericalGrid(int cells) {
  const std::vector<int> counts = cells_of_collars(std::max(cells, 6));
  const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
  double above = 0;
  edges_.push_back(1);
  for (const int count : counts) {
    first_.push_back(size());
    count_.push_back(count);
    above += count;
    edges_.push_back(above == all ? -1 : 1 - 2 * above / all);
    for (int k = 0; k < count; ++k)
      cells_.push_back(
          {edges_.back(), edges_[edges_.size() - 2], 2 * pi * k / count, 2 * pi * (k + 1) / count});
  }
}

Vec3 SphericalGrid::Cell::centre() const {
  if (z_high == 1) return Vec3::UnitZ();
  if (z_low == -1) return -Vec3::UnitZ();
  const double z = (z_low + z_high) / 2, azimuth = (azimuth_low + azimuth_high) / 2;
  const double ring = std::sqrt(1 - z * z);
  return {ring * std::cos(azimuth), ring * std::sin(azimuth), z};
}

double SphericalGrid::solid_angle() const {
  return 4 * pi / size();
}

int SphericalGrid::find(const Vec3& direction) const {
  const double z = direction.z() / direction.norm();
  const auto below = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, z, std::greater<>());
  const auto collar = static_cast<std::size_t>(below - edges_.begin() - 1);
  double azimuth = std::atan2(direction.y(), direction.x());
  if (azimuth < 0) azimuth += 2 * pi;
  const int sector = static_cast<int>(azimuth / (2 * pi) * count_[collar]);
  return first_[collar] + std::min(sector, count_[collar] - 1);
}

void SphericalDistribution::add(const SphericalDistribution& other) {
  for (std::size_t cell = 0; cell < contacts.size(); ++cell) {
    contacts[cell] += other.contacts[cell];
    normal[cell] += other.normal[cell];
  }
}

SphericalDistribution spherical_distribution(const Packing& packing, const SphericalGrid& grid) {
  const auto cells = static_cast<std::size_t>(grid.size());
  SphericalDistribution result{std::vector<double>(cells, 0.0), std::vector<double>(cells, 0.0)};
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    const double force = normal_force(contact);
    for (const Vec3& direction : {contact.branch, Vec3(-contact.branch)}) {
      const auto cell = static_cast<std::size_t>(grid.find(direction));
      result.contacts[cell] += share;
      result.normal[cell] += share * force;
    }
  }
  return result;
}

std::vector<double> spherical_density(const std::vector<double>& values, const SphericalGrid& grid) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  std::vector<double> density(values.size(), 0.0);
  if (sum <= 0) return density;
  for (std::size_t i = 0; i < values.size(); ++i) density[i] = values[i] / sum / grid.solid_angle();
  return density;
}

double second_order_density(const Mat3& fabric, const Vec3& direction) {
  const Vec3 n = direction.normalized();
  return (1 + 7.5 * (n.dot(fabric * n) - fabric.trace() / 3)) / (4 * pi);
}

Mat3 normal_force_moment(const Packing& packing) {
  Mat3 sum = Mat3::Zero();
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    const Vec3 normal = contact.branch.normalized();
    sum += share * normal_force(contact) * normal * normal.transpose();
  }
  return sum;
}

}  // namespace suffuse::micromechanics
