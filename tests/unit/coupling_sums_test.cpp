// What runs report: means over planes, and the grains' file.
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "prescribed_grains.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/coupling/effects.h"
#include "suffuse/coupling/grain_output.h"
#include "suffuse/coupling/plane_sums.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

constexpr double kSpacing = 1e-4;
constexpr int kCells = 20;

CoupledSettings water() {
  CoupledSettings settings;
  settings.units.density = 1000;
  settings.units.viscosity = 1e-6;
  settings.units.spacing = kSpacing;
  settings.units.relaxation_time = 0.8;
  settings.solids.cells.coefficient = 3;
  settings.solids.automatic_coefficient = false;
  settings.substeps = 1;
  return settings;
}

PrescribedGrains::Grain sphere(double cells_radius, const Vec3& velocity) {
  PrescribedGrains::Grain g;
  g.position = 0.5 * kCells * kSpacing * Vec3::Ones();
  g.radius = cells_radius * kSpacing;
  g.velocity = velocity;
  return g;
}

}  // namespace

TEST_CASE("Planes know the flux, the solids' share of it, and the pressure between them") {
  const Vec3 velocity(2e-4, -1e-4, 5e-4);  // m/s, of everything
  const CoupledSettings settings = water();
  const lbm::Units units(settings.units);
  PrescribedGrains grains({sphere(5, velocity)}, kCells * kSpacing * Vec3::Ones(), {true, true, true},
                          units.time_step());
  CoupledSimulation simulation(
      settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, {kCells, kCells, kCells}), Vec3::Zero(), grains);
  const double slope = 1e-4;  // of the density, a cell
  simulation.fluid().set_equilibrium([&](const lbm::Index3& cell) {
    return lbm::FluidPoint{1 - slope * (cell[2] - 9.5), units.velocity_to_lattice(velocity)};
  });
  const PlaneSums planes = plane_sums(simulation.map(), 2);
  const double solid = sphere_volume(5) / std::pow(kCells, 3);
  CHECK(planes.porosity(0, kCells) == Approx(1 - solid).epsilon(1e-3));  // the fraction's own error
  // Everything moves alike: fluid and grain together at the velocity, the fluid's share by the porosity.
  for (int a = 0; a < 3; ++a) {
    CHECK(planes.flux[10][a] == Approx(velocity[a]).epsilon(1e-6));
    CHECK(planes.superficial_velocity()[a] == Approx(planes.porosity(0, kCells) * velocity[a]).epsilon(1e-5));
  }
  const double pascal_a_cell = units.density_lattice_to_pressure(1 - slope);
  CHECK(planes.pressure_at(10 * kSpacing) == Approx(0).margin(1e-9 * std::abs(pascal_a_cell)));
  CHECK(planes.pressure_at(0) == Approx(-10 * pascal_a_cell).epsilon(1e-9));
  CHECK(hydraulic_gradient(planes, 2 * kSpacing, 17 * kSpacing, 50, 9810) ==
        Approx((-pascal_a_cell / kSpacing + 50) / 9810).epsilon(1e-9));
  CHECK(planes.stored_mass == Approx(0).margin(1e-12 * planes.fluid_mass));

  const MappedScene before = simulation.map();
  simulation.step();
  CHECK_THROWS_AS(plane_sums(before, 2), std::logic_error);
}

TEST_CASE("Pressure spreads through Appendix C's bed as its two-way account says") {
  // 12 mm at a porosity of 0.37, Sauter diameter 0.348 mm, 0.04 mm cells and 16 microseconds: k = 8.6e-11
  // m^2, c_s^2 = 2.08 m^2/s^2, so D = k c_s^2/nu = 1.8e-4 m^2/s and h^2/(pi^2 D) = 0.082 s.
  lbm::UnitsRequest request;
  request.density = 1000;
  request.viscosity = 1e-6;
  request.spacing = 4e-5;
  request.time_step = 1.6e-5;
  CHECK(pressure_diffusion_time(0.012, 0.37, 0.348e-3, lbm::Units(request)) == Approx(0.082).epsilon(0.01));
}

TEST_CASE("The grains' file holds every grain once, with its loads") {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  // Rank r owns r + 1 grains.
  const int owned = rank + 1;
  std::vector<double> position, velocity, radius, load;
  std::vector<int> id;
  for (int n = 0; n < owned; ++n) {
    const int number = rank * 100 + n;
    id.push_back(number);
    radius.push_back(1e-3 * (number + 1));
    for (int a = 0; a < 3; ++a) position.push_back(number + 0.1 * a);
    for (int a = 0; a < 3; ++a) velocity.push_back(-number);
    for (int a = 0; a < 6; ++a) load.push_back(number + 0.01 * a);
  }
  GrainArrays arrays;
  arrays.owned = arrays.total = owned;
  arrays.position = position.data();
  arrays.velocity = arrays.angular_velocity = velocity.data();
  arrays.radius = radius.data();
  arrays.id = id.data();
  GrainMemory memory;
  memory.load = load.data();
  const std::string path = "coupling_sums_grains_" + std::to_string(ranks) + ".h5";
  GrainOutput output(path, false);
  GrainSnapshot snapshot{5, 0.5, arrays, memory, Vec3(0, -1, -2), Vec3(1, 2, 3), {true, false, true}};
  output.write(snapshot, MPI_COMM_WORLD);
  // As many contacts as grains, each with a second listing that does not count.
  micromechanics::Packing network;
  for (int n = 0; n < 2 * owned; ++n) {
    if (n < owned) network.grains.push_back({rank * 100 + n, 1, Vec3::Zero()});
    const std::int64_t own = rank * 100 + n / 2;
    micromechanics::Contact contact;
    contact.first = n / 2;
    contact.force = Vec3(1, 2, 3) * static_cast<double>(own);
    contact.branch = -contact.force;
    contact.friction = 0.25;
    contact.friction_limit = 2.5;
    contact.spring_force = 0.5;
    using micromechanics::Listing;
    add_image_contact(
        network, contact,
        {own + (n % 2 == 0 ? 1000 : 2000), 1, n % 2 == 0 ? Listing::whole : Listing::elsewhere});
  }
  snapshot.step = 7;
  snapshot.time = 0.7;
  snapshot.network = &network;
  output.write(snapshot, MPI_COMM_WORLD);
  output.write(snapshot, MPI_COMM_WORLD);  // again: replaced
  const Hdf5File file(path, Hdf5File::Mode::read, MPI_COMM_WORLD);
  CHECK(file.names_in("/") == std::vector<std::string>{"step_000000000005", "step_000000000007"});
  const std::string group = "/step_000000000007/grains";
  const auto all = static_cast<std::size_t>(ranks * (ranks + 1) / 2);
  REQUIRE(file.extents(group + "/id").at(0) == all);
  const auto ids = file.read<std::int64_t>(group + "/id", {{all}, {0}, {all}});
  const auto torque = file.read<double>(group + "/torque", {{all, 3}, {0, 0}, {all, 3}});
  const auto diameter = file.read<double>(group + "/diameter", {{all}, {0}, {all}});
  for (std::size_t n = 0; n < all; ++n) {
    CHECK(torque[3 * n + 2] == static_cast<double>(ids[n]) + 0.05);
    CHECK(diameter[n] == Approx(2e-3 * (static_cast<double>(ids[n]) + 1)).epsilon(1e-15));
  }
  CHECK(file.number_attribute("/step_000000000007", "time_s") == 0.7);

  const std::string contacts = "/step_000000000007/contacts";
  CHECK_FALSE(file.exists("/step_000000000005/contacts"));
  REQUIRE(file.extents(contacts + "/friction") == std::vector<std::size_t>{all});
  const auto pairs = file.read<std::int64_t>(contacts + "/ids", {{all, 2}, {0, 0}, {all, 2}});
  const auto force = file.read<double>(contacts + "/force", {{all, 3}, {0, 0}, {all, 3}});
  CHECK(file.read<double>(contacts + "/friction_limit", {{all}, {0}, {all}}) ==
        std::vector<double>(all, 2.5));
  CHECK(file.read<double>(contacts + "/spring_force", {{all}, {0}, {all}}) == std::vector<double>(all, 0.5));
  const auto branch = file.read<double>(contacts + "/branch", {{all, 3}, {0, 0}, {all, 3}});
  for (std::size_t n = 0; n < all; ++n) {
    CHECK(pairs[2 * n] == ids[n]);  // in the order of the ranks, as the grains
    CHECK(pairs[2 * n + 1] == ids[n] + 1000);
    CHECK(force[3 * n + 2] == 3. * static_cast<double>(ids[n]));
    CHECK(branch[3 * n + 1] == -2. * static_cast<double>(ids[n]));
  }
  for (const char* step : {"/step_000000000005", "/step_000000000007"}) {
    CHECK(file.read<double>(std::string(step) + "/box", {{2, 3}, {0, 0}, {2, 3}}) ==
          std::vector<double>{0, -1, -2, 1, 2, 3});
    CHECK(file.read<std::uint8_t>(std::string(step) + "/periodic", {{3}, {0}, {3}}) ==
          std::vector<std::uint8_t>{1, 0, 1});
  }
}
