// Grains beside walls that stand inside the box of water.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "coupled_scene.h"
#include "suffuse/coupling/plane_sums.h"
#include "suffuse/lbm/wall_shapes.h"
#include "suffuse/lbm/wall_spaces.h"

using namespace suffuse;
using namespace suffuse::coupling;
using namespace suffuse::coupling::test;

namespace {

/// Periodic but across z, where the box ends with no-slip faces.
CoupledSettings channel(const SolidSettings& solids) {
  CoupledSettings settings = lattice_settings(0.6, solids);
  settings.fluid.faces =
      lbm::test::by_axis(lbm::FaceKind::periodic, lbm::FaceKind::periodic, lbm::FaceKind::no_slip);
  return settings;
}

void add_walls(Scene& scene, const std::vector<lbm::WallShape>& shapes, const Index3& wet) {
  const lbm::Fluid& fluid = scene.simulation->fluid();
  lbm::WallCuts cuts = lbm::cut_links(fluid.decomposition(), fluid.settings().faces, shapes);
  scene.simulation->set_walls(lbm::divide(fluid.decomposition(), fluid.settings().faces,
                                          std::move(cuts.links), std::vector<Index3>{wet}),
                              "walls");
}

}  // namespace

TEST_CASE("what lies behind a wall is neither pore nor grain") {
  // The sphere stands on a plane at 2.7: 0.3 cells of its height reach into cells behind it.
  const Vec3 velocity(2e-3, -1e-3, 0);
  PrescribedGrains::Grain sphere = sphere_at(Vec3(6.1, 5.8, 5.7), 3);
  sphere.velocity = velocity;
  Scene scene(channel(default_solids()), {12, 12, 12}, {sphere});
  add_walls(scene, {lbm::PlaneWall{2, 2.7}}, {6, 5, 5});
  scene.simulation->fluid().set_equilibrium([&](const Index3&) { return lbm::FluidPoint{1, velocity}; });
  scene.simulation->map();
  CHECK(scene.simulation->overlap() == 0);
  CHECK(scene.simulation->grains_behind_walls() == 0);

  const PlaneSums planes = plane_sums(scene.simulation->map(), 2);
  CHECK(planes.first_with_room() == 3);
  CHECK(planes.end_of_room() == 12);
  CHECK(planes.room[2] == 0);
  CHECK(planes.room[3] == 1);
  const double cap = std::numbers::pi * 0.3 * 0.3 * (3 - 0.1), solid = sphere_volume(3) - cap;
  CHECK(planes.porosity(0, 12) == Approx(1 - solid / (9 * 144)).epsilon(2e-4));
  CHECK(planes.fluid_mass == Approx(9 * 144 - solid).epsilon(2e-4));
  CHECK(planes.room_below(5) == Approx(2));
  // Fluid and grain move alike.
  for (int a = 0; a < 3; ++a) {
    CHECK(planes.flux[5][a] == Approx(velocity[a]).epsilon(1e-6).margin(1e-12));
    CHECK(planes.superficial_velocity()[a] ==
          Approx(planes.porosity(0, 12) * velocity[a]).epsilon(1e-5).margin(1e-12));
  }
  CHECK(planes.porosity(0, 2) == 0);
  CHECK(planes.superficial_velocity(0, 2).norm() == 0);
}

TEST_CASE("a cylinder's discharge and superficial velocity are those of its inside") {
  Scene scene(channel(default_solids()), {14, 14, 4}, {});
  add_walls(scene, {lbm::CylinderWall{2, 5.3, Vec3(7.1, 6.9, 0)}}, {7, 7, 2});
  scene.simulation->fluid().set_equilibrium([&](const Index3&) {
    return lbm::FluidPoint{1, Vec3(0, 0, 0.01)};
  });
  scene.simulation->map();
  const PlaneSums planes = plane_sums(scene.simulation->map(), 2);
  CHECK(planes.room[0] * 196 == Approx(std::numbers::pi * 5.3 * 5.3).epsilon(0.03));  // whole cells
  CHECK(planes.superficial_velocity()[2] == Approx(0.01).epsilon(1e-9));
  CHECK(planes.flux[0][2] == Approx(0.01 * planes.room[0]).epsilon(1e-9));
  CHECK(planes.porosity(0, 4) == 1);
}

TEST_CASE("a grain that leans over a wall gets from behind it what it gets from beyond a face: nothing") {
  for (const bool thesis : {false, true}) {
    const SolidSettings solids = thesis ? thesis_solids() : default_solids();
    PrescribedGrains::Grain sphere = sphere_at(Vec3(6.3, 5.8, 2.8), 3);  // 0.2 cells beyond
    sphere.velocity = Vec3(4e-3, 1e-3, 0);
    sphere.angular_velocity = Vec3(0, 1e-3, 2e-3);
    Scene face(channel(solids), {13, 12, 10}, {sphere});
    sphere.position[2] += 3;
    Scene wall(channel(solids), {13, 12, 16}, {sphere});
    add_walls(wall, {lbm::PlaneWall{2, 3}, lbm::PlaneWall{2, 13}}, {6, 5, 8});
    CHECK(wall.simulation->fluid().has_closed_cells());
    for (Scene* scene : {&face, &wall}) {
      scene->grains.mobile = true;  // mapped anew in every step
      scene->run(60);
    }
    const Vec3 force = face.force(), torque = face.torque();
    INFO((thesis ? "thesis" : "default") << ": " << force.transpose() << ", " << torque.transpose());
    CHECK(force.norm() > 1e-2);
    // Boxes of two sizes are cut otherwise among ranks, and spheres' distances rounded otherwise to float.
    const double round_off = 1e-5;
    CHECK((wall.force() - force).norm() < round_off * force.norm());
    CHECK((wall.torque() - torque).norm() < round_off * torque.norm());
    // Held from now on: the sums are made afterwards then.
    for (Scene* scene : {&face, &wall}) {
      scene->grains.mobile = false;
      scene->run(5);
    }
    CHECK((wall.force() - face.force()).norm() < round_off * force.norm());
  }
}

TEST_CASE("a grain where there is no water is found") {
  Scene scene(channel(default_solids()), {12, 12, 14},
              {sphere_at(Vec3(6, 6, 9), 2.5), sphere_at(Vec3(4, 4, 2), 1)});
  add_walls(scene, {lbm::PlaneWall{2, 5}}, {6, 6, 9});
  scene.simulation->map();
  CHECK(scene.simulation->grains_behind_walls() == 1);
  add_walls(scene, {}, {6, 6, 9});  // the wall is gone
  scene.simulation->map();
  CHECK(scene.simulation->grains_behind_walls() == 0);
  CHECK(plane_sums(scene.simulation->map(), 2).room[0] == 1);
}
