// Parts of a packing: those of a partition add up to the whole, and a part of a regular array has the whole's
// mean values.

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "hand_packings.h"
#include "suffuse/micromechanics/broken_contacts.h"
#include "suffuse/micromechanics/bulk_stiffness.h"
#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/directional_distribution.h"
#include "suffuse/micromechanics/fabric.h"
#include "suffuse/micromechanics/force_distribution.h"
#include "suffuse/micromechanics/layers.h"
#include "suffuse/micromechanics/load_shares.h"
#include "suffuse/micromechanics/sample_extent.h"
#include "suffuse/micromechanics/slipping.h"
#include "suffuse/micromechanics/spherical_distribution.h"
#include "suffuse/micromechanics/stress.h"
#include "suffuse/micromechanics/stress_reduction.h"
#include "suffuse/micromechanics/strong_contacts.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

constexpr int kSide = 4;
constexpr double kSpacing = 2.0;  // m
constexpr SizeSplit kSplit{1.9};

/// 64 grains of radii 0.9 to 1.4 m about a periodic cubic lattice, their forces with a tangential part.
Packing uneven_packing() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.9, 1.4), shift(-0.2, 0.2);
  Packing packing;
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    const Vec3 place(n % kSide, n / kSide % kSide, n / kSide / kSide);
    const Vec3 centre =
        kSpacing * (place + Vec3::Constant(0.5)) + Vec3(shift(random), shift(random), shift(random));
    packing.grains.push_back(grain(n + 1, radius(random), centre));
  }
  const double period = kSide * kSpacing;
  packing.volume = std::pow(period, 3);
  add_periodic_contacts(
      packing, Vec3::Constant(period),
      [](const Vec3& branch) -> Vec3 {
        const Vec3 normal = branch.normalized();
        return (3 - branch.norm()) * (10 * normal + normal.cross(Vec3(0.3, 0.5, 2)));
      },
      0.3);
  return packing;
}

/// Is a centre, in any period, in this eighth of the box?
auto in_eighth(int eighth) {
  return [eighth](const Vec3& centre) {
    int own = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double half = kSide * kSpacing / 2;
      const double at = centre[axis] - 2 * half * std::floor(centre[axis] / (2 * half));
      own |= (at < half ? 0 : 1) << axis;
    }
    return own == eighth;
  };
}

LayerGrid three_layers() {
  LayerGrid grid;
  grid.layers = 3;
  grid.column = {Vec3::Zero(), Vec3::Constant(kSide * kSpacing)};
  grid.period = grid.column.high;
  return grid;
}

/// What is added up over contacts, whole or as one rank's or one part's share.
std::vector<double> sums_of(const Packing& packing) {
  std::vector<double> sums;
  const auto add_matrix = [&](const Mat3& matrix) {
    sums.insert(sums.end(), matrix.data(), matrix.data() + 9);
  };
  add_matrix(stress_times_volume(packing).matrix());
  const StressReductionSums reduction = stress_reduction_sums(packing, kSplit, GrainArm::contact_point);
  add_matrix(reduction.all_stress.matrix());
  add_matrix(reduction.fines_stress.matrix());
  const CoordinationSums z = coordination_sums(packing, kSplit);
  sums.insert(sums.end(),
              {z.grains, z.contacts, z.coarse_coarse, z.fine_coarse, z.fine_fine, z.contact_volume});
  const SlidingSums slides = sliding_sums(packing, {0.2});
  sums.insert(sums.end(),
              {slides.contacts, slides.sliding, slides.slipping_index, slides.mobilised_friction});
  const StrongSums strong = strong_sums(packing, 12);
  sums.insert(sums.end(), {strong.contacts, strong.strong});
  add_matrix(strong.strong_stress.matrix());
  add_matrix(normal_force_moment(packing));
  const LoadShareSums load = load_share_sums(packing, kSplit);
  sums.insert(sums.end(), {load.coarse_coarse, load.fine_coarse, load.fine_fine});
  std::vector<double> stiffness;
  for (const Contact& contact : packing.contacts) stiffness.push_back(normal_force(contact));
  sums.push_back(stiffness_length_sum(packing, stiffness));
  const PlaneDistribution plane = plane_distribution(packing, Plane::xz, 12);
  sums.insert(sums.end(), plane.tangential.begin(), plane.tangential.end());
  const FabricSums fabric = fabric_sums(packing);
  sums.insert(sums.end(), fabric.planes[1].counts.begin(), fabric.planes[1].counts.end());
  add_matrix(fabric.normals.matrix());
  for (const SlidingSums& layer : layer_sliding_sums(packing, three_layers(), {0.2}))
    sums.insert(sums.end(), {layer.contacts, layer.sliding});
  const SphericalGrid sphere(200);
  const SphericalDistribution directions = spherical_distribution(packing, sphere);
  sums.insert(sums.end(), directions.contacts.begin(), directions.contacts.end());
  const NormalForceSums normal = normal_force_sums(packing);
  sums.insert(sums.end(), {normal.contacts, normal.normal_force});
  return sums;
}

void add(std::vector<double>& total, const std::vector<double>& part) {
  if (total.empty()) total.assign(part.size(), 0.0);
  for (std::size_t i = 0; i < part.size(); ++i) total[i] += part[i];
}

}  // namespace

TEST_CASE("the parts of a partition add up to the whole, on any number of ranks") {
  const Packing whole = uneven_packing();
  REQUIRE(whole.contacts.size() > 150);
  const std::vector<double> expected = sums_of(whole);
  for (const int ranks : {1, 3}) {
    std::vector<double> total;
    double across = 0;
    for (const Packing& rank : shared_out(whole, ranks))
      for (int eighth = 0; eighth < 8; ++eighth) {
        const Packing part = part_inside(rank, in_eighth(eighth));
        add(total, sums_of(part));
        for (const Contact& contact : part.contacts) across += contact_share(part, contact) == 0.5;
      }
    REQUIRE(across > 100);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      CAPTURE(ranks, i);
      CHECK(total[i] == Approx(expected[i]).margin(1e-10));
    }
  }
}

TEST_CASE("a part of a cubic array has the array's coordination, stress, fabric and forces") {
  // 7, 2 and 6 N along x, y and z.
  const Packing whole = simple_cubic(
      5, 0.5, [](const Vec3& branch) -> Vec3 { return Vec3(7, 2, 6).cwiseProduct(branch.normalized()); });
  // A slab one grain high: without its contacts with grains outside it had none along z.
  Packing part = part_inside(whole, [](const Vec3& centre) {
    return (centre.array() > 1).all() && (centre.array() < 3).all() && centre[2] < 2;
  });
  part.volume = 4;
  REQUIRE(part.grains.size() == 4);
  CHECK(coordination(coordination_sums(part, kSplit), part.volume).mean == Approx(6));
  const Mat3 stress = stress_times_volume(whole).matrix() / whole.volume;
  CHECK((stress_times_volume(part).matrix() / part.volume - stress).norm() < 1e-12 * stress.norm());
  CHECK((fabric_tensor(fabric_sums(part)) - Mat3::Identity() / 3).norm() < 1e-12);
  const ForceDistribution forces = force_distribution(part, {}), expected = force_distribution(whole, {});
  CHECK(forces.mean_normal == Approx(5));
  CHECK(forces.coefficient_of_variation == Approx(expected.coefficient_of_variation));
  CHECK(forces.tail_exponent == Approx(expected.tail_exponent));
  for (std::size_t bin = 0; bin < expected.normal.size(); ++bin)
    CHECK(forces.normal[bin] == Approx(expected.normal[bin]));
  // 4 contacts within, 16 with grains outside: as pairs they are all of the part.
  CHECK(contact_pairs(part).size() == 20);
  CHECK(normal_force_sums(part).contacts == Approx(12));
}
