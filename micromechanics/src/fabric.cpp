#include "suffuse/micromechanics/fabric.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace suffuse::micromechanics {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr int kHalf = kOrientationBins / 2;

void add_angle(OrientationHistogram& histogram, double along_first, double along_second, double share) {
  if (along_first == 0 && along_second == 0) return;
  // The sign of a normal has no meaning: take the half turn [0, π) and add its opposite bin, so that the
  // histogram does not depend on which grain was listed first.
  if (along_second < 0 || (along_second == 0 && along_first < 0)) {
    along_first = -along_first;
    along_second = -along_second;
  }
  const double angle = std::atan2(along_second, along_first);
  const int bin = std::min(static_cast<int>(angle / kTwoPi * kOrientationBins), kHalf - 1);
  histogram.counts[static_cast<std::size_t>(bin)] += share;
  histogram.counts[static_cast<std::size_t>(bin + kHalf)] += share;
}

}  // namespace

FabricSums fabric_sums(const Packing& packing) {
  FabricSums sums;
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    const Vec3 normal = contact.branch.normalized();
    sums.contacts += share;
    sums.normals.add(share * normal * normal.transpose());
    for (std::size_t plane = 0; plane < 3; ++plane)
      add_angle(sums.planes[plane], normal[kPlaneAxes[plane][0]], normal[kPlaneAxes[plane][1]], share);
  }
  return sums;
}

Mat3 fabric_tensor(const FabricSums& sums) {
  if (sums.contacts <= 0) return Mat3::Zero();
  return sums.normals.matrix() / sums.contacts;
}

double deviatoric_fabric(const Mat3& fabric) {
  const Mat3 deviator = fabric - fabric.trace() / 3 * Mat3::Identity();
  return std::sqrt(1.5 * deviator.cwiseProduct(deviator).sum());
}

double bin_centre(int bin) {
  return (bin + 0.5) * kTwoPi / kOrientationBins;
}

std::array<double, kOrientationBins> orientation_density(const OrientationHistogram& histogram) {
  std::array<double, kOrientationBins> density{};
  const double total = std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0.0);
  if (total <= 0) return density;
  for (std::size_t i = 0; i < density.size(); ++i)
    density[i] = histogram.counts[i] / total * kOrientationBins / kTwoPi;
  return density;
}

double RoseFit::density(double angle) const {
  return (1 + anisotropy * std::cos(2 * (angle - direction))) / kTwoPi;
}

RoseFit fit_rose(const OrientationHistogram& histogram) {
  // cos 2θ and sin 2θ are orthogonal over equally spaced bins and to the constant: the normal equations are
  // diagonal.
  const auto density = orientation_density(histogram);
  double cosine = 0, sine = 0;
  for (int bin = 0; bin < kOrientationBins; ++bin) {
    cosine += density[static_cast<std::size_t>(bin)] * std::cos(2 * bin_centre(bin)) * 2 / kOrientationBins;
    sine += density[static_cast<std::size_t>(bin)] * std::sin(2 * bin_centre(bin)) * 2 / kOrientationBins;
  }
  return {kTwoPi * std::hypot(cosine, sine), std::atan2(sine, cosine) / 2};
}

}  // namespace suffuse::micromechanics
