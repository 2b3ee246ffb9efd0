// What the fluid loses the grains gain: total momentum to round-off, on any number of ranks; and the first
// acceleration of a sphere that is let go.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "prescribed_grains.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/coupling/virtual_mass.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

CoupledSettings periodic_water(double relaxation_time) {
  CoupledSettings settings;
  settings.units.density = 1000;
  settings.units.viscosity = 1e-6;
  settings.units.spacing = 1e-4;
  settings.units.relaxation_time = relaxation_time;
  settings.solids.cells.coefficient = 2.8;
  settings.solids.automatic_coefficient = false;
  settings.substeps = 1;
  return settings;
}

double fluid_step(const CoupledSettings& settings) {
  return lbm::Units(settings.units).time_step();
}

/// Fluid and grains, without the fluid that the grains' cells hold and with what the virtual drag withholds:
/// conserved from the first step on, since
/// m (v' - v) + W' - W = (F_exchange + d/dt of the held momentum) dt.
Vec3 total_momentum(const CoupledSimulation& simulation, PrescribedGrains& grains) {
  const lbm::Units& units = simulation.units();
  const double cell = units.density() * std::pow(units.spacing(), 3);
  Vec3 sum = cell * units.velocity_to_si(simulation.fluid().momentum());
  const GrainRecord* records = grains.memory().record;
  for (std::size_t n = 0; n < grains.list.size(); ++n) {
    const auto& g = grains.list[n];
    const GrainRecord& record = records[n];
    const auto past = [](const double* values) { return Vec3(Eigen::Map<const Vec3>(values)); };
    const Vec3 held = sphere_volume(g.radius) * units.density() * past(record.velocity) +
                      past(record.internal_fluid_momentum);
    sum += sphere_volume(g.radius) * g.density * g.velocity - held;
    sum += past(record.withheld_impulse);
  }
  return sum;
}

}  // namespace

TEST_CASE("Fluid and grains together keep their momentum") {
  const auto solid_operator = GENERATE(lbm::SolidOperator::force, lbm::SolidOperator::sc1,
                                       lbm::SolidOperator::sc2, lbm::SolidOperator::sc3);
  const double relaxation_time = GENERATE(0.53, 1.2);
  CoupledSettings settings = periodic_water(relaxation_time);
  settings.solids.cells.solid_operator = solid_operator;
  // SC3 with Noble and Torczynski's weighting swings in whole cells and throws free grains about: not here.
  if (solid_operator == lbm::SolidOperator::sc1 || solid_operator == lbm::SolidOperator::sc2) {
    settings.solids.cells.weighting = lbm::SolidWeighting::noble_torczynski;
    settings.solids.cells.coefficient = 1;
  }
  const double dx = 1e-4, step = fluid_step(settings);
  const Vec3 box = dx * Vec3(26, 20, 22);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1), speed(-1, 1);
  std::vector<PrescribedGrains::Grain> list;
  for (int n = 0; n < 9; ++n) {  // overlapping ones among them: cells are shared
    PrescribedGrains::Grain g;
    g.position = box.cwiseProduct(Vec3(unit(random), unit(random), unit(random)));
    g.velocity = 0.02 * dx / step * Vec3(speed(random), speed(random), speed(random));
    g.angular_velocity = 0.005 / step * Vec3(speed(random), speed(random), speed(random));
    g.radius = dx * (1.5 + 2 * unit(random));
    list.push_back(g);
  }
  PrescribedGrains grains(list, box, {true, true, true}, step);
  grains.mobile = grains.free = true;
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, {26, 20, 22}),
                               Vec3::Zero(), grains);
  simulation.step();
  const Vec3 before = total_momentum(simulation, grains);
  double scale = 0;
  for (const auto& g : list) scale += sphere_volume(g.radius) * g.density * g.velocity.norm();
  double first_speed = 0, last_speed = 0;
  for (const auto& g : list) first_speed += g.velocity.norm();
  for (int n = 0; n < 50; ++n) simulation.step();
  for (const auto& g : grains.list) last_speed += g.velocity.norm();
  CHECK(last_speed < 0.9 * first_speed);  // the water does brake them
  CHECK((total_momentum(simulation, grains) - before).norm() < 1e-12 * scale);
}

namespace {

/// One sphere in the middle of a box with free-slip walls, driven by its buoyant weight.
struct Release {
  Release(double ratio, double relaxation_time, double cells_radius, int cells, double g, int substeps)
      : settings(periodic_water(relaxation_time)),
        grains({sphere(ratio, cells_radius, cells)}, 1e-4 * Vec3(cells, cells, cells), {false, false, false},
               fluid_step(settings) / substeps) {
    settings.substeps = substeps;
    settings.gravity = grains.gravity = Vec3(0, 0, -g);
    for (auto& face : settings.fluid.faces) face.kind = lbm::FaceKind::free_slip;
    grains.mobile = grains.free = true;
  }
  static PrescribedGrains::Grain sphere(double ratio, double cells_radius, int cells) {
    PrescribedGrains::Grain g;
    g.position = 0.5e-4 * Vec3(cells, cells, cells);
    g.radius = 1e-4 * cells_radius;
    g.density = 1000 * ratio;
    return g;
  }
  CoupledSettings settings;
  PrescribedGrains grains;
};

}  // namespace

TEST_CASE("A sphere let go in water starts with its buoyant weight over its own and the added mass") {
  // (rho_s - rho_f) g / (rho_s + rho_f/2), less what Basset's force takes: to first order the share
  // 6 sqrt(nu t/pi)/a / (rho_s/rho_f + 1/2). A sphere of 20 cells at a low viscosity, after the 20 steps that
  // sound needs around it and before the boundary layer has grown to a fifth of the radius.
  const double ratio = GENERATE(2.65, 1.16, 0.5);
  const int substeps = GENERATE(1, 20);
  constexpr double tau = 0.505, radius = 10, g = 0.2;
  constexpr int cells = 64, steps = 60;
  Release scene(ratio, tau, radius, cells, g, substeps);
  CoupledSimulation simulation(scene.settings,
                               lbm::Decomposition::balanced(MPI_COMM_WORLD, {cells, cells, cells}),
                               Vec3::Zero(), scene.grains);
  for (int n = 0; n < steps; ++n) simulation.step();
  const double layer = std::sqrt(lbm::viscosity_of(tau) * steps / std::numbers::pi);
  const double basset = 6 * layer / radius / (ratio + 0.5);
  const double time = steps * fluid_step(scene.settings);
  const double expected = (ratio - 1) / (ratio + 0.5) * -g * time * (1 - basset);
  INFO("density ratio " << ratio << ", Basset's share " << basset << ", substeps " << substeps);
  // Next order of the expansion, about basset^2, and the finite box: 5 %.
  CHECK(scene.grains.list[0].velocity[2] == Approx(expected).epsilon(0.05));
}

TEST_CASE("Grains lighter than the water rise steadily") {
  // What ranks change is the first test's; one rank is enough for the physics.
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks > 1) return;
  const double ratio = GENERATE(0.9, 0.3, 0.1);
  const double tau = GENERATE(0.53, 0.8, 1.5);
  const double radius = GENERATE(1., 2.5, 6.);
  const int substeps = radius > 5 ? 1 : GENERATE(1, 20);
  const int cells = radius > 5 ? 32 : 20;
  // Slow enough for Stokes' law: gravity from a terminal velocity of 2e-3 cells a step.
  const double nu = lbm::viscosity_of(tau), dx = 1e-4;
  Release scene(ratio, tau, radius, cells, 0, substeps);
  const double step = fluid_step(scene.settings), speed = 2e-3 * dx / step;
  const double g = 9. / 2 * 1e-6 * speed / (radius * radius * dx * dx) / (1 - ratio);
  scene.settings.gravity = scene.grains.gravity = Vec3(0, 0, -g);
  CoupledSimulation simulation(scene.settings,
                               lbm::Decomposition::balanced(MPI_COMM_WORLD, {cells, cells, cells}),
                               Vec3::Zero(), scene.grains);
  const int steps = static_cast<int>(std::min(600., 100 + 2 * radius * radius / nu));
  double fastest = 0, last = 0;
  for (int n = 0; n < steps; ++n) {
    simulation.step();
    const double now = scene.grains.list[0].velocity[2];
    fastest = std::max(fastest, std::abs(now));
    last = now;
  }
  INFO("density ratio " << ratio << ", tau " << tau << ", radius " << radius << ": " << last / speed
                        << ", fastest " << fastest / speed);
  CHECK(last > 0.1 * speed);
  CHECK(fastest < 1.5 * speed);
}
