#include "suffuse/micromechanics/directional_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace suffuse::micromechanics {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::vector<double> per_contact(const std::vector<double>& sums, const std::vector<double>& contacts) {
  std::vector<double> result(sums.size(), 0.0);
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (contacts[i] > 0) result[i] = sums[i] / contacts[i];
  return result;
}

HarmonicFit fit(std::span<const double> values, int highest, bool over_the_mean) {
  const double n = static_cast<double>(values.size());
  HarmonicFit result;
  result.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  result.scale = over_the_mean ? result.mean : 1;
  // Cosines and sines of different orders are orthogonal over equally spaced angles: no system to solve.
  for (int k = 2; k <= highest; k += 2) {
    double cosine = 0, sine = 0;
    for (std::size_t bin = 0; bin < values.size(); ++bin) {
      const double angle = (static_cast<double>(bin) + 0.5) * kFullTurn / n;
      cosine += values[bin] * std::cos(k * angle) * 2 / n;
      sine += values[bin] * std::sin(k * angle) * 2 / n;
    }
    const double amplitude = result.scale != 0 ? std::hypot(cosine, sine) / result.scale : 0;
    result.harmonics.push_back({k, amplitude, std::atan2(sine, cosine) / k});
  }
  return result;
}

}  // namespace

double PlaneDistribution::centre(int bin) const {
  return (bin + 0.5) * width();
}

double PlaneDistribution::width() const {
  return kFullTurn / bins();
}

std::vector<double> PlaneDistribution::contact_density() const {
  const double sum = total(contacts);
  return scaled(contacts, sum > 0 ? 1 / (sum * width()) : 0);
}

std::vector<double> PlaneDistribution::normal_force_density() const {
  const double sum = total(normal);
  return scaled(normal, sum > 0 ? 1 / (sum * width()) : 0);
}

std::vector<double> PlaneDistribution::mean_normal_force() const {
  const std::vector<double> force = per_contact(normal, contacts);
  const double mean = total(force) / bins();
  return scaled(force, mean > 0 ? 1 / mean : 0);
}

std::vector<double> PlaneDistribution::mean_tangential_force() const {
  const double mean = total(per_contact(normal, contacts)) / bins();
  return scaled(per_contact(tangential, contacts), mean > 0 ? 1 / mean : 0);
}

void PlaneDistribution::add(const PlaneDistribution& other) {
  for (std::size_t bin = 0; bin < contacts.size(); ++bin) {
    contacts[bin] += other.contacts[bin];
    normal[bin] += other.normal[bin];
    tangential[bin] += other.tangential[bin];
  }
}

PlaneDistribution plane_distribution(const Packing& packing, Plane plane, int bins) {
  const std::array<int, 2> axes = kPlaneAxes[static_cast<std::size_t>(plane)];
  const int half = bins / 2;
  PlaneDistribution result;
  for (auto* values : {&result.contacts, &result.normal, &result.tangential})
    values->assign(index(bins), 0.0);
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    const Vec3 normal = contact.branch.normalized();
    double along = normal[axes[0]], across = normal[axes[1]];
    const double in_plane = std::hypot(along, across);
    if (in_plane == 0) continue;
    const double force = contact.force.dot(normal);
    const Vec3 tangential = contact.force - force * normal;
    // Seen from the other grain the normal, the force and t all change their signs: f·t does not.
    const double sideways = (-across * tangential[axes[0]] + along * tangential[axes[1]]) / in_plane;
    if (across < 0 || (across == 0 && along < 0)) {
      along = -along;
      across = -across;
    }
    const int bin = std::min(static_cast<int>(std::atan2(across, along) / kFullTurn * bins), half - 1);
    for (const int where : {bin, bin + half}) {
      result.contacts[index(where)] += share;
      result.normal[index(where)] += share * force;
      result.tangential[index(where)] += share * sideways;
    }
  }
  return result;
}

double HarmonicFit::operator()(double angle) const {
  double value = mean;
  for (const Harmonic& h : harmonics)
    value += scale * h.amplitude * std::cos(h.order * (angle - h.direction));
  return value;
}

HarmonicFit fit_harmonics(std::span<const double> values, int highest) {
  return fit(values, highest, true);
}

HarmonicFit fit_harmonics_absolute(std::span<const double> values, int highest) {
  return fit(values, highest, false);
}

double bin_attenuation(int order, int bins) {
  const double half = order * std::numbers::pi / bins;
  return std::sin(half) / half;
}

double tangential_direction(const Harmonic& second) {
  const double direction = second.direction + std::numbers::pi / 4;
  return direction > std::numbers::pi / 2 ? direction - std::numbers::pi : direction;
}

}  // namespace suffuse::micromechanics
