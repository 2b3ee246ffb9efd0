// Directions, forces and rattlers: fits find the coefficients that went in; distributions add up to one.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "hand_packings.h"
#include "suffuse/micromechanics/directional_distribution.h"
#include "suffuse/micromechanics/force_distribution.h"
#include "suffuse/micromechanics/load_shares.h"
#include "suffuse/micromechanics/rattlers.h"
#include "suffuse/micromechanics/spherical_distribution.h"
#include "suffuse/micromechanics/stress.h"

using namespace suffuse;
using namespace suffuse::micromechanics;

namespace {

using std::numbers::pi;

/// Contacts in the plane x–z at evenly spaced angles, thinned out so that their density is E(θ).
Packing planar_packing(const std::function<double(double)>& density_over_mean,
                       const std::function<Vec3(double, const Vec3&)>& force) {
  constexpr int kAngles = 36000;
  Packing packing;
  packing.grains = {testing::grain(1, 0.5, Vec3::Zero()), testing::grain(2, 0.5, Vec3::UnitX())};
  packing.volume = 10;
  double due = 0;
  for (int k = 0; k < kAngles; ++k) {
    const double angle = (k + 0.5) * 2 * pi / kAngles;
    due += density_over_mean(angle) / 2;
    if (due < 1) continue;
    due -= 1;
    const Vec3 normal(std::cos(angle), 0, std::sin(angle));
    packing.contacts.push_back({0, 1, normal, force(angle, normal), 0.5});
  }
  return packing;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("fits find known Fourier coefficients of the contacts and of both parts of the force") {
  const double a = 0.4, theta_a = 1.1, b = 0.15, theta_b = 0.3, an = 0.5, theta_n = 0.8, at = 0.2,
               theta_t = 0.9;
  const Packing packing = planar_packing(
      [&](double t) { return 1 + a * std::cos(2 * (t - theta_a)) + b * std::cos(4 * (t - theta_b)); },
      [&](double t, const Vec3& n) -> Vec3 {
        const Vec3 along(-n.z(), 0, n.x());
        return 2 * (1 + an * std::cos(2 * (t - theta_n))) * n - 2 * at * std::sin(2 * (t - theta_t)) * along;
      });
  const int bins = 72;
  const PlaneDistribution plane = plane_distribution(packing, Plane::xz, bins);
  const HarmonicFit contacts = fit_harmonics(plane.contact_density(), 6);
  const HarmonicFit normal = fit_harmonics(plane.mean_normal_force(), 4);
  const HarmonicFit tangential = fit_harmonics_absolute(plane.mean_tangential_force(), 4);
  // A bin averages over its width: bin_attenuation. 250 contacts a bin, whose thinning moves a bin's count by
  // one: 4e-3.
  CHECK(contacts.mean == Approx(1 / (2 * pi)));
  CHECK(contacts.harmonics[0].amplitude / bin_attenuation(2, bins) == Approx(a).margin(4e-3));
  CHECK(contacts.harmonics[0].direction == Approx(theta_a).margin(4e-3));
  CHECK(contacts.harmonics[1].amplitude / bin_attenuation(4, bins) == Approx(b).margin(4e-3));
  CHECK(contacts.harmonics[1].direction == Approx(theta_b).margin(8e-3));
  CHECK(contacts.harmonics[2].amplitude == Approx(0).margin(4e-3));
  // The mean force of a bin is that of its contacts, which are not spread evenly in it: their density changes
  // by up to 2 a Δ = 7 % over the bin, and the force by 8 %, which makes 1e-3 of the force.
  CHECK(normal.harmonics[0].amplitude / bin_attenuation(2, bins) == Approx(an).margin(2e-3));
  CHECK(normal.harmonics[0].direction == Approx(theta_n).margin(2e-3));
  CHECK(tangential.harmonics[0].amplitude / bin_attenuation(2, bins) == Approx(at).margin(2e-3));
  CHECK(tangential_direction(tangential.harmonics[0]) == Approx(theta_t).margin(4e-3));
  CHECK(contacts(0.3) ==
        Approx((1 + a * std::cos(2 * (0.3 - theta_a)) + b * std::cos(4 * (0.3 - theta_b))) / (2 * pi))
            .margin(1e-3));
  CHECK(sum_of(plane.contact_density()) * plane.width() == Approx(1));
  CHECK(sum_of(plane.normal_force_density()) * plane.width() == Approx(1));
}

TEST_CASE(
    "with 36 bins the second order is Appendix D's fit and the grain that is named first does not matter") {
  Packing packing = planar_packing(
      [](double t) { return 1 + 0.3 * std::cos(2 * (t - 0.6)); },
      [](double t, const Vec3& n) -> Vec3 { return n + 0.1 * std::sin(2 * t) * Vec3(-n.z(), 0, n.x()); });
  const RoseFit appendix = fit_rose(fabric_sums(packing).planes[1]);
  const PlaneDistribution plane = plane_distribution(packing, Plane::xz, kOrientationBins);
  const Harmonic second = fit_harmonics(plane.contact_density(), 4).harmonics[0];
  CHECK(second.amplitude == Approx(appendix.anisotropy).epsilon(1e-12));
  CHECK(second.direction == Approx(appendix.direction).epsilon(1e-12));
  for (std::size_t k = 0; k < packing.contacts.size(); k += 2) {
    packing.contacts[k].branch *= -1;
    packing.contacts[k].force *= -1;
  }
  const PlaneDistribution swapped = plane_distribution(packing, Plane::xz, kOrientationBins);
  for (std::size_t bin = 0; bin < plane.contacts.size(); ++bin) {
    CHECK(swapped.contacts[bin] == plane.contacts[bin]);
    CHECK(swapped.tangential[bin] == Approx(plane.tangential[bin]).margin(1e-12));
  }
}

TEST_CASE("cells of the sphere have one area, cover it once, and find the cell of each direction") {
  for (const int wanted : {6, 50, 200, 1000}) {
    const SphericalGrid grid(wanted);
    INFO(wanted << " wanted, " << grid.size() << " made");
    CHECK(std::abs(grid.size() - wanted) <= 0.1 * wanted + 3);
    double covered = 0;
    for (int k = 0; k < grid.size(); ++k) {
      const SphericalGrid::Cell& cell = grid.cell(k);
      const double area = (cell.z_high - cell.z_low) * (cell.azimuth_high - cell.azimuth_low);
      CHECK(area == Approx(grid.solid_angle()).epsilon(1e-9));
      covered += area;
      CHECK(grid.find(cell.centre()) == k);
    }
    CHECK(covered == Approx(4 * pi));
  }
}

TEST_CASE("the spherical histogram of even directions is flat, that of a second-order density is its fit") {
  std::mt19937_64 random(3);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  const Mat3 anisotropy = (Mat3() << 0.4, 0.1, 0, 0.1, -0.1, 0.2, 0, 0.2, -0.3).finished();
  Packing packing;
  packing.grains = {testing::grain(1, 0.5, Vec3::Zero()), testing::grain(2, 0.5, Vec3::UnitX())};
  Mat3 moments = Mat3::Zero();
  const int count = 200000;
  while (static_cast<int>(packing.contacts.size()) < count) {
    const Vec3 n = Vec3(gauss(random), gauss(random), gauss(random)).normalized();
    if (uniform(random) * 1.6 > 1 + n.dot(anisotropy * n)) continue;
    packing.contacts.push_back({0, 1, n, n, 0.5});
    moments += n * n.transpose() / count;
  }
  const SphericalGrid grid(100);
  const SphericalDistribution sphere = spherical_distribution(packing, grid);
  const std::vector<double> density = spherical_density(sphere.contacts, grid);
  CHECK(sum_of(sphere.contacts) == 2 * count);
  CHECK(sum_of(density) * grid.solid_angle() == Approx(1));
  for (int k = 0; k < grid.size(); ++k) {
    const Vec3 n = grid.cell(k).centre();
    // D of the fabric tensor is the anisotropy itself: ⟨n n⟩ = 1/3 + 2 D/15. Scatter of 2e5 contacts: 3e-3 of
    // φ, 15/2 of it in D.
    const double expected = (1 + n.dot(anisotropy * n)) / (4 * pi);
    CHECK(second_order_density(moments, n) == Approx(expected).margin(0.03 / (4 * pi)));
    // 4,000 directions a cell: 1.6 % (4 standard deviations: 6.5 %), and the cell's own width, some 2 %.
    CHECK(density[static_cast<std::size_t>(k)] == Approx(expected).epsilon(0.09));
  }
}

TEST_CASE("forces drawn from an exponential have P(f) = exp(-f) and a tail exponent of 1") {
  std::mt19937_64 random(11);
  std::exponential_distribution<double> exponential(1 / 0.7);
  Packing packing;
  packing.grains = {testing::grain(1, 0.5, Vec3::Zero()), testing::grain(2, 0.5, Vec3::UnitX())};
  const int count = 100000;
  for (int k = 0; k < count; ++k) {
    const double force = exponential(random);
    packing.contacts.push_back({0, 1, Vec3::UnitX(), Vec3(force, 0.2 * force, 0), 0.5});
  }
  const ForceBins bins{0.25, 12};
  const ForceDistribution forces = force_distribution(packing, bins);
  // Standard errors of 1e5 draws: 0.3 % of the mean, 0.5 % of the exponent; four of them.
  CHECK(forces.mean_normal == Approx(0.7).epsilon(0.013));
  CHECK(forces.mean_tangential == Approx(0.2 * forces.mean_normal).epsilon(1e-12));
  CHECK(forces.tail_exponent == Approx(1).epsilon(0.02));
  CHECK(forces.coefficient_of_variation == Approx(1).epsilon(0.02));
  CHECK(sum_of(forces.normal) * bins.width + forces.normal_beyond == Approx(1));
  CHECK(sum_of(forces.tangential) * bins.width + forces.tangential_beyond == Approx(1));
  for (std::size_t bin = 0; bin < forces.normal.size(); ++bin) {
    const double low = static_cast<double>(bin) * bins.width;
    const double expected = (std::exp(-low) - std::exp(-low - bins.width)) / bins.width;
    CHECK(forces.normal[bin] == Approx(expected).margin(4 * std::sqrt(expected / bins.width / count)));
  }
}

TEST_CASE("rattlers: a chain falls apart from its end, a ring stays") {
  Packing packing;
  for (int i = 0; i < 7; ++i)
    packing.grains.push_back(testing::grain(i + 1, i < 4 ? 1.0 : 0.5, Vec3::Zero()));
  const auto touch = [&](int a, int b) {
    packing.contacts.push_back({a, b, Vec3::UnitX(), Vec3::UnitX(), 0.3});
  };
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 0}, {3, 4}, {4, 5}})
    touch(a, b);  // a ring of 0..3, a chain 4, 5; 6 alone
  const std::vector<bool> bearing = load_bearing(packing, 2);
  CHECK(bearing == std::vector<bool>{true, true, true, true, false, false, false});
  const Rattlers loose = rattlers(packing, bearing, {1.5});
  CHECK(loose.share == Approx(3. / 7));
  CHECK(loose.fines_share == 1);
  CHECK(loose.solid_share == Approx(3 * 0.125 / (4 + 3 * 0.125)));
  CHECK(load_bearing(packing, 3) == std::vector<bool>(7, false));
  CHECK(load_bearing(packing, 0) == std::vector<bool>(7, true));
}

TEST_CASE("load shares of the classes of contacts add up to one, and to the share of each by hand") {
  Packing packing;
  packing.grains = {testing::grain(1, 1, Vec3::Zero()), testing::grain(2, 1, Vec3::Zero()),
                    testing::grain(3, 0.25, Vec3::Zero()), testing::grain(4, 0.25, Vec3::Zero())};
  packing.volume = 100;
  const auto push = [&](int a, int b, double length, double force) {
    packing.contacts.push_back({a, b, length * Vec3::UnitZ(), force * Vec3::UnitZ(), 0.3});
  };
  push(0, 1, 2, 3);       // 6
  push(1, 2, 1.25, 2);    // 2.5
  push(3, 0, 1.25, 0.4);  // 0.5
  push(2, 3, 0.5, 2);     // 1
  const LoadShares shares = load_shares(load_share_sums(packing, {1.0}));
  CHECK(shares.coarse_coarse == Approx(0.6));
  CHECK(shares.fine_coarse == Approx(0.3));
  CHECK(shares.fine_fine == Approx(0.1));
  CHECK(load_shares({}).fine_fine == 0);
}
