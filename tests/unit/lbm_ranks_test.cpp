// The same fluid on any number of ranks, cut anywhere: bit for bit what one rank computes.
#include <catch2/catch.hpp>

#include "lbm_test_tools.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

constexpr Index3 kCells{13, 12, 14};

std::uint8_t rocks(const Index3& c) {
  return noise(c, 3, 11) > 0.7 ? 1 : 0;
}

/// Number of populations that differ, over all ranks, after some steps; every rank runs the whole box by
/// itself too.
long differing_populations(const FluidSettings& settings, const Decomposition& parts, bool solids) {
  Fluid shared(settings, parts);
  Fluid alone(settings, Decomposition::balanced(MPI_COMM_SELF, kCells));
  for (Fluid* fluid : {&shared, &alone}) {
    if (solids) fluid->set_solids(rocks);
    fluid->set_force(Vec3(1e-4, 0, -2e-4));
    for_each_cell(fluid->decomposition().local_box(), [&](int x, int y, int z) {
      if (fluid->is_solid({x, y, z})) return;
      for (int i = 0; i < kDirections; ++i)
        fluid->set_population(i, {x, y, z}, random_population(i, {x, y, z}));
    });
  }
  long mine = 0, all = 0;
  for (int step = 0; step < 9; ++step) {
    shared.step();
    alone.step();
    for_each_cell(parts.local_box(), [&](int x, int y, int z) {
      for (int i = 0; i < kDirections; ++i)
        if (!alone.is_solid({x, y, z}) && shared.population(i, {x, y, z}) != alone.population(i, {x, y, z}))
          ++mine;
    });
  }
  MPI_Allreduce(&mine, &all, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
  // The force is summed over ranks in another order: equal to rounding only.
  CHECK((shared.solid_force(1) - alone.solid_force(1)).norm() < 1e-12);
  CHECK(std::isfinite(shared.extremes().largest_speed));
  return all;
}

std::vector<FaceConditions> face_mixes() {
  std::vector<FaceConditions> mixes;
  mixes.push_back(same_everywhere(FaceKind::periodic));
  mixes.push_back(by_axis(FaceKind::periodic, FaceKind::no_slip, FaceKind::free_slip));
  FaceConditions through = by_axis(FaceKind::free_slip, FaceKind::periodic, FaceKind::pressure);
  through[4].density = 1.01;
  mixes.push_back(through);
  FaceConditions inlet = by_axis(FaceKind::velocity, FaceKind::free_slip, FaceKind::no_slip);
  inlet[0].velocity = Vec3(0.01, 0, 0.002);
  inlet[1].kind = FaceKind::pressure;
  inlet[2].kind = FaceKind::velocity;
  inlet[2].velocity = Vec3(0.02, 0, 0);
  mixes.push_back(inlet);
  return mixes;
}

int ranks() {
  int n = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

}  // namespace

TEST_CASE("results do not depend on the number of ranks, bit for bit") {
  for (const FaceConditions& faces : face_mixes())
    for (const Precision precision : {Precision::double_precision, Precision::float_precision})
      for (const CollisionOperator op : {CollisionOperator::trt, CollisionOperator::central_moments})
        for (const bool solids : {false, true}) {
          FluidSettings settings;
          settings.faces = faces;
          settings.precision = precision;
          settings.collision.collision_operator = op;
          settings.collision.smagorinsky = solids ? 0.15 : 0;
          CHECK(differing_populations(settings, Decomposition::balanced(MPI_COMM_WORLD, kCells), solids) ==
                0);
        }
}

TEST_CASE("sub-boxes may be of unequal size and ranks may lie along any axis in any order") {
  for (int axis = 0; axis < 3; ++axis) {
    std::array<std::vector<int>, 3> cuts;
    for (int a = 0; a < 3; ++a) cuts[static_cast<std::size_t>(a)] = {0, kCells[static_cast<std::size_t>(a)]};
    std::vector<int>& along = cuts[static_cast<std::size_t>(axis)];
    along = {0};
    for (int r = 1; r < ranks(); ++r) along.push_back(r);  // one cell each, the last rank has the rest
    along.push_back(kCells[static_cast<std::size_t>(axis)]);
    const Decomposition parts = Decomposition::from_cuts(MPI_COMM_WORLD, cuts, [&](const Index3& c) {
      return ranks() - 1 - c[static_cast<std::size_t>(axis)];
    });
    for (const FaceConditions& faces : face_mixes()) {
      FluidSettings settings;
      settings.faces = faces;
      CHECK(differing_populations(settings, parts, true) == 0);
    }
  }
}

TEST_CASE("every cell belongs to one rank") {
  const Decomposition parts = Decomposition::balanced(MPI_COMM_WORLD, kCells);
  long mine = static_cast<long>(parts.local_box().volume()), all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
  CHECK(all == 13L * 12 * 14);
}

TEST_CASE("cuts that leave a rank without cells are refused with a sentence") {
  CHECK_THROWS_WITH(Decomposition::from_cuts(MPI_COMM_SELF, {std::vector<int>{0, 4, 4}, {0, 5}, {0, 6}},
                                             [](const Index3&) { return 0; }),
                    Catch::Contains("cuts between ranks along x = 0 4 4") && Catch::Contains("fewer ranks"));
  CHECK_THROWS_WITH(Decomposition::balanced(MPI_COMM_SELF, {4, 0, 4}), Catch::Contains("cells along y = 0"));
}
