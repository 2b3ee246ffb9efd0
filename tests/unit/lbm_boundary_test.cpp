// Rules for faces, edges and corners, and the mixes of faces that are refused.
#include <catch2/catch.hpp>

#include "lbm_test_tools.h"
#include "suffuse/common/error.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;
using Action = LinkRule::Action;

namespace {

FaceConditions all_walls() {
  return same_everywhere(FaceKind::no_slip);
}

}  // namespace

TEST_CASE("the lattice's index rules hold for all directions") {
  double weights = 0;
  for (int i = 0; i < kDirections; ++i) {
    weights += kWeight[i];
    for (int a = 0; a < 3; ++a) {
      CHECK(kVelocity[opposite(i)][a] == -kVelocity[i][a]);
      CHECK(kVelocity[reflected(i, 0)][a] == (a == 0 ? -1 : 1) * kVelocity[i][a]);
    }
    CHECK(direction_of(kVelocity[i][0], kVelocity[i][1], kVelocity[i][2]) == i);
  }
  CHECK(weights == Approx(1).epsilon(1e-15));
  CHECK(direction_of(1, 1, 1) == -1);
}

TEST_CASE("the lattice is isotropic up to fourth order") {
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double second = 0, fourth = 0;
      for (int i = 0; i < kDirections; ++i) {
        const int* c = kVelocity[i];
        second += kWeight[i] * c[a] * c[b];
        fourth += kWeight[i] * c[a] * c[a] * c[b] * c[b];
      }
      CHECK(second == Approx(a == b ? 1. / 3 : 0).margin(1e-15));
      CHECK(fourth == Approx(a == b ? 3. / 9 : 1. / 9).margin(1e-15));
    }
}

TEST_CASE("where two faces meet the stronger one decides") {
  FaceConditions faces = all_walls();
  faces[0].kind = FaceKind::free_slip;  // xlo
  faces[1].kind = FaceKind::pressure;   // xhi
  faces[2].kind = FaceKind::velocity;   // ylo
  faces[4].kind = FaceKind::free_slip;  // zlo
  CHECK(link_rule(faces, {0, 0, 0}).action == Action::stream);
  CHECK(link_rule(faces, {-1, 0, 0}).action == Action::mirror);
  CHECK(link_rule(faces, {-1, 0, -1}).action == Action::mirror);
  CHECK(link_rule(faces, {1, 0, -1}).action == Action::extend);
  CHECK(link_rule(faces, {1, 0, 0}).face == Face::xhi);
  CHECK(link_rule(faces, {1, -1, 0}).action == Action::bounce);
  CHECK(link_rule(faces, {1, -1, 0}).face == Face::ylo);
  CHECK(link_rule(faces, {0, -1, 1}).face == Face::zhi);  // no-slip beats a moving wall: lids do not leak
  CHECK(link_rule(faces, {1, 1, 0}).face == Face::yhi);
  faces[5].kind = FaceKind::pressure;
  CHECK(link_rule(faces, {1, 0, 1}).action == Action::anti_bounce);
  faces[1].kind = FaceKind::velocity;
  const LinkRule shared = link_rule(faces, {1, -1, 0});
  CHECK(shared.face != shared.other);
}

TEST_CASE("mixes of faces that mean nothing are refused with the face and a remedy") {
  const Index3 cells{4, 5, 6};
  FaceConditions faces = all_walls();
  CHECK_NOTHROW(check(faces, cells));
  faces[3].kind = FaceKind::periodic;
  CHECK_THROWS_WITH(check(faces, cells),
                    "fluid boundary ylo: kind = noslip, must be periodic because yhi is; or "
                    "give both faces another kind");
  faces = all_walls();
  faces[0].kind = FaceKind::velocity;
  faces[0].velocity = Vec3(0.01, 0, 0);
  CHECK_THROWS_WITH(check(faces, cells),
                    Catch::Contains("net inflow") && Catch::Contains("make the outlet a pressure"));
  faces[1] = faces[0];  // what enters at xlo leaves at xhi
  CHECK_NOTHROW(check(faces, cells));
  faces[1].kind = FaceKind::pressure;
  CHECK_NOTHROW(check(faces, cells));
  faces[2] = {FaceKind::pressure, Vec3::Zero(), 1.01};
  CHECK_THROWS_WITH(check(faces, cells),
                    Catch::Contains("ylo") && Catch::Contains("which meets it along an edge"));
  faces[2].density = 1;
  CHECK_NOTHROW(check(faces, cells));
  faces[2].density = -0.5;
  CHECK_THROWS_WITH(check(faces, cells), Catch::Contains("be > 0"));
  faces = all_walls();
  faces[5].kind = FaceKind::velocity;
  faces[5].velocity = Vec3(0.7, 0, 0);
  CHECK_THROWS_WITH(check(faces, cells), Catch::Contains("speed of sound"));
}

TEST_CASE("collision settings that cannot work are refused with the remedy") {
  CollisionSettings settings;
  settings.relaxation_time = 0.49;
  CHECK_THROWS_WITH(check(settings),
                    "fluid: relaxation_time = 0.49, must be > 0.5; raise the viscosity or the time step");
  settings.relaxation_time = std::nan("");
  CHECK_THROWS_AS(check(settings), UserError);
  settings = {};
  settings.magic = 0;
  CHECK_THROWS_WITH(check(settings), Catch::Contains("magic"));
  settings = {};
  settings.smagorinsky = -0.1;
  CHECK_THROWS_WITH(check(settings), Catch::Contains("smagorinsky"));
}

TEST_CASE("a velocity face lets in its area times its velocity, whatever its sides are") {
  // In the first step from rest nothing else moves mass. A diagonal link of an edge cell that ends in a wall
  // would be a sixth of a cell's share: 1 to 2 % of a face this small.
  constexpr Index3 cells{7, 6, 5};
  const double speed = 0.01, area = 7 * 6;
  for (const FaceKind x : {FaceKind::no_slip, FaceKind::velocity, FaceKind::free_slip})
    for (const FaceKind y :
         {FaceKind::no_slip, FaceKind::velocity, FaceKind::free_slip, FaceKind::periodic}) {
      FluidSettings settings;
      settings.faces = by_axis(x, y, FaceKind::pressure);
      settings.faces[4] = {FaceKind::velocity, Vec3(0, 0, speed), 1};
      for (const bool incompressible : {false, true}) {
        settings.collision.incompressible = incompressible;
        Fluid fluid(settings, Decomposition::balanced(MPI_COMM_SELF, cells));
        fluid.step();
        INFO(name_of(x) << " " << name_of(y));
        CHECK(fluid.mass_deviation() == Approx(speed * area).epsilon(1e-12));
      }
    }
}

TEST_CASE("the kind of a face cannot change during a run, its value can") {
  FluidSettings settings;
  settings.faces = all_walls();
  settings.faces[5].kind = FaceKind::velocity;
  Fluid fluid(settings, Decomposition::balanced(MPI_COMM_SELF, {4, 4, 4}));
  FaceConditions faces = settings.faces;
  faces[5].velocity = Vec3(0.01, 0, 0);
  CHECK_NOTHROW(fluid.set_faces(faces));
  faces[0].kind = FaceKind::free_slip;
  CHECK_THROWS_WITH(fluid.set_faces(faces), Catch::Contains("xlo: kind = freeslip, must stay noslip"));
}

TEST_CASE("a whole box with ghost cells and padding needs at most ten per cent more than 19 values a cell") {
  const Fluid fluid(FluidSettings{}, Decomposition::balanced(MPI_COMM_SELF, {128, 128, 128}));
  CHECK(static_cast<double>(fluid.bytes()) <= 1.1 * 19 * 8 * 128. * 128 * 128);
  FluidSettings single;
  single.precision = Precision::float_precision;
  const Fluid small(single, Decomposition::balanced(MPI_COMM_SELF, {128, 128, 128}));
  CHECK(static_cast<double>(small.bytes()) <= 1.1 * 19 * 4 * 128. * 128 * 128);
}
