// Free grains over the range of densities, sizes, viscosities and speeds that users will try.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>

#include "coupled_scene.h"

using namespace suffuse;
using namespace suffuse::coupling;
using namespace suffuse::coupling::test;

namespace {

struct Flight {
  double fastest = 0;  ///< of the free flight, over the speed at its start
  double late = 0;     ///< speed after it
  double jump = 0;     ///< largest change of velocity in a step in the last quarter
  bool finite = true;
};

/// A spinning sphere, pushed through water at rest for five steps and then let go for 400.
Flight fly(double tau, double diameter, double ratio, double speed) {
  auto grain = sphere_at(Vec3(12.3, 12.1, 12.4), 0.5 * diameter, ratio);
  grain.velocity = speed * Vec3(0.94, 0.28, 0.19);
  grain.angular_velocity = Vec3(0, 0, speed / diameter);
  const int cells = diameter > 8 ? 40 : 24;
  Scene scene(lattice_settings(tau, default_solids()), {cells, cells, cells}, {grain});
  scene.grains.mobile = true;
  scene.run(5);
  scene.grains.free = true;
  Flight flight;
  Vec3 last = grain.velocity;
  for (int n = 0; n < 400 && flight.finite; ++n) {
    scene.run(1);
    const Vec3 now = scene.grains.list[0].velocity;
    flight.finite = std::isfinite(now.norm()) && now.norm() < 1;
    flight.fastest = std::max(flight.fastest, now.norm() / speed);
    if (n >= 300) flight.jump = std::max(flight.jump, (now - last).norm() / speed);
    flight.late = now.norm() / speed;
    last = now;
  }
  flight.finite = flight.finite && scene.simulation->fluid().extremes().finite;
  return flight;
}

}  // namespace

TEST_CASE("free grains stay steady at every density, size, viscosity and speed") {
  const double tau = GENERATE(0.505, 0.53, 0.8, 1.5);
  for (const double diameter : {1., 2., 5., 12.})
    for (const double ratio : {0.1, 0.3, 0.9, 1.16, 2.65, 7.8})
      for (const double speed : {0.01, 0.05}) {
        const Flight flight = fly(tau, diameter, ratio, speed);
        INFO("tau " << tau << ", " << diameter << " cells, density ratio " << ratio << ", speed " << speed
                    << ": fastest " << flight.fastest << ", late " << flight.late << ", jump "
                    << flight.jump);
        CHECK(flight.finite);
        // The water only brakes. A light grain is thrown back first by the fluid that it had set in motion.
        CHECK(flight.fastest < 1.3);
        // Sound between a large, light sphere and its images swings on at low viscosity: it is an eighth of
        // the box.
        const bool rings = diameter > 8 && ratio < 0.5 && tau < 0.6;
        CHECK(flight.jump < (rings ? 0.3 : 0.05));
      }
}
