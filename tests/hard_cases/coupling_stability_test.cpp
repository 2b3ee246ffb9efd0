// Free grains over the range of densities, sizes, viscosities and speeds that users will try.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>

#include "coupled_scene.h"
#include "suffuse/common/error.h"

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

namespace {

void check_flight(double tau, double diameter, double ratio, double speed) {
  const Flight flight = fly(tau, diameter, ratio, speed);
  INFO("tau " << tau << ", " << diameter << " cells, density ratio " << ratio << ", speed " << speed
              << ": fastest " << flight.fastest << ", late " << flight.late << ", jump " << flight.jump);
  CHECK(flight.finite);
  // The water only brakes. A light grain is thrown back first by the fluid that it had set in motion.
  CHECK(flight.fastest < 1.3);
  // Sound between a large, light sphere and its images swings on at low viscosity: it is an eighth of
  // the box.
  const bool rings = diameter > 8 && ratio < 0.5 && tau < 0.6;
  CHECK(flight.jump < (rings ? 0.3 : 0.05));
}

}  // namespace

TEST_CASE("free grains stay steady at the ends of the ranges of density, size and viscosity") {
  const double tau = GENERATE(0.505, 1.5);
  for (const double diameter : {1., 2., 5.})
    for (const double ratio : {0.1, 0.3, 1.16, 7.8}) check_flight(tau, diameter, ratio, 0.05);
}

TEST_CASE("free grains stay steady at every density, size, viscosity and speed", "[.long]") {
  const double tau = GENERATE(0.505, 0.53, 0.8, 1.5);
  for (const double diameter : {1., 2., 5., 12.})
    for (const double ratio : {0.1, 0.3, 0.9, 1.16, 2.65, 7.8})
      for (const double speed : {0.01, 0.05}) check_flight(tau, diameter, ratio, speed);
}

namespace {

/// Grains of quartz in a dense bed, each on a spring of its own that stands for its contacts.
struct Bed {
  double cells = 3;  ///< a diameter
  double relaxation_time = 0.53;
  double restitution = 0.7;  ///< of the contact that the spring stands for
  std::optional<double> virtual_mass = {};
};

/// By what factor the amplitude of the bed's vibrations changes in a fluid step; `phase`: that of the spring
/// alone, rad a fluid step.
double growth(const Bed& bed, double phase) {
  constexpr double fraction = 0.62;
  const double edge = std::round(2 * bed.cells * std::cbrt(4 * std::numbers::pi / 6 / fraction));
  const int cells = static_cast<int>(edge);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> speed(-1e-5, 1e-5);
  std::vector<PrescribedGrains::Grain> list;
  for (int n = 0; n < 32; ++n) {  // 2 x 2 x 2 face-centred cubes
    constexpr double at[4][3] = {{1, 1, 1}, {3, 3, 1}, {3, 1, 3}, {1, 3, 3}};
    const double* corner = at[n % 4];
    const Vec3 cube(n / 4 % 2, n / 8 % 2, n / 16);
    auto grain = sphere_at(edge / 8 * (4 * cube + Vec3(corner[0], corner[1], corner[2])), 0.5 * bed.cells);
    grain.velocity = Vec3(speed(random), speed(random), speed(random));
    list.push_back(grain);
  }
  CoupledSettings settings = lattice_settings(bed.relaxation_time, default_solids());
  settings.virtual_mass = bed.virtual_mass;
  settings.substeps = 40;
  Scene scene(settings, {cells, cells, cells}, list);
  scene.grains.mobile = scene.grains.free = true;
  const double mass = sphere_volume(0.5 * bed.cells) * list[0].density,
               log_of_restitution = std::log(bed.restitution);
  scene.grains.spring = {mass * phase * phase, -2 * mass * phase * log_of_restitution /
                                                   std::hypot(std::numbers::pi, log_of_restitution)};
  const auto amplitude = [&] {
    double square = 0;
    for (std::size_t n = 0; n < scene.grains.list.size(); ++n)
      square += scene.grains.list[n].velocity.squaredNorm() +
                phase * phase * scene.grains.displacement_of(n).squaredNorm();
    return std::sqrt(square);
  };
  constexpr int first = 30, steps = 60;
  scene.run(first);
  const double before = amplitude();
  scene.run(steps);
  return std::pow(amplitude() / before, 1. / steps);
}

}  // namespace

TEST_CASE("grains that swing on their contacts in a dense bed come to rest, however stiff the contacts") {
  Bed bed;
  bed.cells = GENERATE(2.5, 3., 5.);
  bed.relaxation_time = GENERATE(0.51, 0.53, 0.6);
  for (const double phase : {0.25, 0.5, 1., 1.5, 2., 2.5, 3., 3.5, 4., 5., 7., 10.}) {
    const double change = growth(bed, phase);
    INFO(bed.cells << " cells, tau " << bed.relaxation_time << ", " << phase << " rad a step: " << change);
    // Springs that are all alike swing together in narrow bands; contacts of a bed differ (resting_beds).
    CHECK(change < 1.01);
  }
}

TEST_CASE("growth of vibrations by phase, for docs/decisions/virtual-mass.md", "[.table]") {
  std::printf("cells,tau,foreseen,phase,growth\n");
  for (const double cells : {2.25, 3., 5., 8.})
    for (const double tau : {0.505, 0.51, 0.53, 0.6})
      for (const std::optional<double>& virtual_mass : {std::optional<double>(0.), std::optional<double>()})
        for (const double phase : {0.1, 0.25, 0.5, 1., 1.5, 2., 2.5, 3., 3.5, 4., 5., 7., 10.}) {
          std::printf("%g,%g,%s,%g,", cells, tau, virtual_mass ? "nothing" : "auto", phase);
          try {
            std::printf("%.3f\n", growth({cells, tau, 1., virtual_mass}, phase));
          } catch (const suffuse::LostRun&) {
            std::printf("lost\n");
          }
        }
}
