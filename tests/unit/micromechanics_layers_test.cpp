#include <catch2/catch.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "hand_packings.h"
#include "suffuse/micromechanics/layers.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
using std::numbers::pi;

LayerGrid grid_over(double side, int layers, int axis = 2) {
  LayerGrid grid;
  grid.axis = axis;
  grid.layers = layers;
  grid.column = {Vec3::Zero(), Vec3::Constant(side)};
  grid.period = Vec3::Constant(side);
  return grid;
}

Box half_space_below(double x) {
  return {Vec3::Constant(-kInf), Vec3(x, kInf, kInf)};
}

}  // namespace

TEST_CASE("a sphere cut by one plane gives the spherical segment") {
  const Vec3 centre(1, 2, 3);
  CHECK(sphere_volume_in_box(centre, 2, half_space_below(1)) == Approx(4.0 / 3 * pi * 8 / 2));
  CHECK(sphere_volume_in_box(centre, 2, half_space_below(2)) == Approx(pi * 9 * 3 / 3));
  CHECK(sphere_volume_in_box(centre, 2, half_space_below(-1.1)) == 0);
  CHECK(sphere_volume_in_box(centre, 2, half_space_below(3.5)) == Approx(4.0 / 3 * pi * 8));
}

TEST_CASE("a sphere cut through its centre by two or three planes gives a quarter and an eighth") {
  // 1e-9: the stated error of the quadrature.
  const double whole = 4.0 / 3 * pi;
  CHECK(sphere_volume_in_box(Vec3::Zero(), 1, {Vec3(0, 0, -kInf), Vec3::Constant(kInf)}) ==
        Approx(whole / 4).epsilon(1e-9));
  CHECK(sphere_volume_in_box(Vec3::Zero(), 1, {Vec3::Zero(), Vec3::Constant(kInf)}) ==
        Approx(whole / 8).epsilon(1e-9));
}

TEST_CASE("a cube inside a sphere has its own volume") {
  CHECK(sphere_volume_in_box(Vec3::Zero(), 2, {Vec3(-1, -0.5, -0.7), Vec3(1, 1, 0.2)}) ==
        Approx(2 * 1.5 * 0.9).epsilon(1e-9));
}

TEST_CASE("the boxes of a grid cut a sphere into parts that add up to it") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 centre(uniform(random), uniform(random), uniform(random));
    const double radius = 0.6 + uniform(random);
    double sum = 0;
    for (int x = -3; x < 3; ++x)
      for (int y = -3; y < 3; ++y)
        for (int z = -3; z < 3; ++z)
          sum += sphere_volume_in_box(centre, radius, {0.6 * Vec3(x, y, z), 0.6 * Vec3(x + 1, y + 1, z + 1)});
    CHECK(sum == Approx(4.0 / 3 * pi * std::pow(radius, 3)).epsilon(1e-9));
  }
}

TEST_CASE("layers of a simple cubic array all have its stress, void ratio and coordination") {
  const double radius = 0.5, force = 3;
  const Packing packing = simple_cubic(4, radius, push(force));
  // Borders cut grains in halves (3 layers over 4 planes do not: use 4, 2, 1, shifted column below).
  for (const int layers : {1, 2, 4}) {
    LayerGrid grid = grid_over(4, layers);
    const auto sums = layer_sums(packing, grid, GrainArm::contact_point);
    REQUIRE(sums.size() == static_cast<std::size_t>(layers));
    for (const LayerSums& layer : sums) {
      const LayerState state = layer_state(layer, grid.layer_volume());
      CHECK((state.stress - force * Mat3::Identity()).norm() < 1e-9);  // F/(2R)² = 3; stated error of the cut
      CHECK(state.void_ratio == Approx(6 / pi - 1).epsilon(1e-9));
      CHECK(state.coordination == Approx(6).epsilon(1e-9));
      CHECK(state.stable_share == Approx(1));
      CHECK(state.grains == Approx(64.0 / layers).epsilon(1e-9));
    }
  }
}

TEST_CASE("grains across a periodic face reach the layers at the other end") {
  Packing packing;
  packing.grains.push_back(grain(1, 0.5, Vec3(2, 2, 0.1)));
  packing.volume = 64;
  LayerGrid grid = grid_over(4, 4);
  auto sums = layer_sums(packing, grid, GrainArm::contact_point);
  const double below = pi * 0.4 * 0.4 * (1.5 - 0.4) / 3;  // cap of height 0.4 below z = 0
  CHECK(sums[0].solid_volume == Approx(below));           // numbered from the top
  CHECK(sums[3].solid_volume == Approx(pi / 6 - below));
  CHECK(sums[0].solid_volume + sums[3].solid_volume == Approx(pi / 6).epsilon(1e-14));
  grid.period.setZero();
  sums = layer_sums(packing, grid, GrainArm::contact_point);
  CHECK(sums[0].solid_volume == 0);
}

TEST_CASE("layer sums add up to the whole, by volume and by centre, for any number of layers and ranks") {
  Packing packing = face_centred_cubic(2, 0.4, [](const Vec3& branch) -> Vec3 {
    return Vec3(branch[0] * 1.0 + 0.1 * branch[1], 2 * branch[1], 3 * branch[2]);
  });
  const double side = std::cbrt(packing.volume);
  const Mat3 whole = stress_times_volume(packing).matrix();
  for (const GrainShare share : {GrainShare::volume, GrainShare::centre})
    for (const int layers : {1, 3, 7})
      for (const int axis : {0, 1, 2}) {
        LayerGrid grid = grid_over(side, layers, axis);
        grid.share = share;
        std::vector<LayerSums> total(static_cast<std::size_t>(layers));
        for (const Packing& part : shared_out(packing, 3)) {
          auto sums = layer_sums(part, grid, GrainArm::contact_point);
          for (std::size_t k = 0; k < total.size(); ++k) add_sums(total[k], sums[k]);
        }
        Mat3 stress = Mat3::Zero();
        double grains = 0;
        for (const LayerSums& layer : total) {
          stress += layer.stress.matrix();
          grains += layer.grains;
        }
        CHECK((stress - whole).norm() < 1e-9 * whole.norm());  // stated error of the cut
        CHECK(grains == Approx(32).epsilon(1e-9));
      }
}

TEST_CASE("a trimmed column takes only what lies in it, and an uncut side takes grains whole") {
  Packing packing = simple_cubic(4, 0.5, push(3));
  LayerGrid grid = grid_over(4, 2);
  grid.column.low[0] = 1.25;  // through grains, at a quarter of a cell
  grid.column.high[0] = 3.25;
  const auto sums = layer_sums(packing, grid, GrainArm::contact_point);
  for (const LayerSums& layer : sums) {
    // Two cells wide wherever it starts, so the state is that of the array.
    const LayerState state = layer_state(layer, grid.layer_volume());
    CHECK(state.void_ratio == Approx(6 / pi - 1).epsilon(1e-8));
    CHECK(state.stress(2, 2) == Approx(3).epsilon(1e-8));
  }
  // Walls instead of periodic faces: nothing outside is cut off when the sides are the sample's own.
  LayerGrid walls = grid_over(4, 2);
  walls.period.setZero();
  walls.cut = {false, false, true};
  packing.grains = {grain(1, 0.5, Vec3(0.45, 2, 1))};
  packing.contacts.clear();
  CHECK(layer_sums(packing, walls, GrainArm::contact_point)[1].solid_volume == Approx(pi / 6));
}

TEST_CASE("layers are numbered from the top unless asked otherwise") {
  Packing packing;
  packing.grains.push_back(grain(1, 0.1, Vec3(1, 1, 3.5)));
  packing.volume = 64;
  LayerGrid grid = grid_over(4, 4);
  CHECK(layer_sums(packing, grid, GrainArm::contact_point)[0].grains == 1);
  grid.numbered_from_top = false;
  CHECK(layer_sums(packing, grid, GrainArm::contact_point)[3].grains == 1);
}

TEST_CASE("the variance of layer void ratios follows eq 6.1") {
  const std::vector<double> ratios{0.5, 0.6, 0.7};
  CHECK(void_ratio_variance(ratios, 0.6) == Approx(0.01));
  CHECK(void_ratio_variance(ratios, 0.5) == Approx(0.025));
  CHECK(void_ratio_variance({}, 0.5) == 0);
}

TEST_CASE("an empty layer has no void ratio") {
  const LayerState state = layer_state({}, 1);
  CHECK(state.void_ratio == 0);
  CHECK(state.coordination == 0);
  CHECK(state.stress.norm() == 0);
}

TEST_CASE("fines of a layer: their share, the stress they carry, coordination and constraints by hand") {
  // Two layers of a simple cubic array of radius 1/2 pushed by F, with a fine grain in each cube's middle at
  // the heights 1 and 3: below it touches its eight corners by g, at their limit of friction; above it
  // rattles.
  const double coarse = 0.5, fine = 0.3, force = 3, corner = 0.7, friction = 0.3;
  Packing packing = simple_cubic(4, coarse, push(force), friction);
  const std::size_t coarse_grains = packing.grains.size();
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (const int z : {1, 3})
        packing.grains.push_back(
            grain(static_cast<std::int64_t>(packing.grains.size()) + 1, fine, Vec3(x, y, z)));
  for (std::size_t i = coarse_grains; i < packing.grains.size(); ++i)
    for (std::size_t j = 0; j < coarse_grains && packing.grains[i].position.z() < 2; ++j) {
      Vec3 branch = packing.grains[i].position - packing.grains[j].position;
      for (int axis = 0; axis < 3; ++axis) branch[axis] -= 4 * std::round(branch[axis] / 4);
      if (branch.norm() > 0.9) continue;
      const Vec3 normal = branch.normalized(), along = Vec3(normal.y(), -normal.x(), 0).normalized();
      packing.contacts.push_back(
          {static_cast<int>(i), static_cast<int>(j), branch, corner * (normal + friction * along), friction});
    }
  LayerGrid grid = grid_over(4, 2);
  grid.cut = {false, false, false};
  const auto grains = layer_sums(packing, grid, GrainArm::pair_halves, {2 * 0.4});
  const auto contacts = layer_sliding_sums(packing, grid, {});
  const LayerFines above = layer_fines(grains[0], contacts[0], grid.layer_volume());
  const LayerFines below = layer_fines(grains[1], contacts[1], grid.layer_volume());

  const double solids = 32 * sphere_volume(coarse) + 16 * sphere_volume(fine);
  const double share = 16 * sphere_volume(fine) / solids;
  for (const LayerFines& layer : {above, below}) {
    CHECK(layer.fines_share == Approx(share));
    CHECK(layer.porosity == Approx(1 - solids / 32));
  }
  CHECK(above.coordination == Approx(32. * 6 / 48));
  CHECK(below.coordination == Approx((32. * 6 + 16 * 8 * 2) / 48));
  // Traces: a coarse grain of the array 6 F/2, a fine one 8 g d/2 and as much again in its neighbours, d =
  // √3/2.
  const double distance = std::sqrt(3.) / 2, of_fines = 16 * 4 * corner * distance;
  CHECK(below.sufian == Approx(of_fines / (32 * 3 * force + 2 * of_fines)));
  CHECK(below.shire == Approx(below.sufian / share));
  CHECK(above.sufian == 0);
  // Of 96 contacts of the array a layer has 64 flat ones and 32 upright ones, those on a border the layer
  // above it.
  CHECK(above.sliding_share == 0);
  CHECK(below.sliding_share == Approx(128. / (96 + 128)));
  CHECK(below.constraint_ratio == Approx(below.coordination * (3 - 2 * below.sliding_share) / 12));
  CHECK(above.constraint_ratio == Approx(1));
}
