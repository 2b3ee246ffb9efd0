#include "suffuse/coupling/plane_sums.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace suffuse::coupling {

namespace {

/// What is summed for each plane, lattice units.
struct Sums {
  double flux[3], solid_flux[3], open, pressure;
};
constexpr int kSums = sizeof(Sums) / sizeof(double);

/// Over all cells: mass, twice the kinetic energy, deviation from rest.
struct Totals {
  double mass, energy, stored;
};
static_assert(sizeof(Totals) <= sizeof(Sums));

}  // namespace

PlaneSums plane_sums(const CoupledSimulation& simulation, int axis) {
  const lbm::Fluid& fluid = simulation.fluid();
  const lbm::Units& units = simulation.units();
  const lbm::Decomposition& d = fluid.decomposition();
  const auto along = static_cast<std::size_t>(axis);
  std::vector<Sums> sums(static_cast<std::size_t>(d.cells()[along]) + 1, Sums{});
  Totals totals{};
  double extremes[3] = {0, -1e300, -1e300};  // squared speed, density, -density
  fluid.for_each_point([&](const lbm::Index3& cell, const lbm::FluidPoint& point, double solid_fraction) {
    const double open = 1 - solid_fraction;
    const Vec3 solid = simulation.mapping().solid_flux(cell);
    Sums& plane = sums[static_cast<std::size_t>(cell[along])];
    for (int a = 0; a < 3; ++a) {
      plane.flux[a] += point.velocity[a];
      plane.solid_flux[a] += solid[a];
    }
    plane.open += open;
    plane.pressure += open * (point.density - 1);
    const double speed_squared = point.velocity.squaredNorm();
    totals.mass += open * point.density;
    totals.energy += open * point.density * speed_squared;
    totals.stored += point.density - 1;
    extremes[0] = std::max(extremes[0], speed_squared);
    extremes[1] = std::max(extremes[1], point.density);
    extremes[2] = std::max(extremes[2], -point.density);
  });
  std::memcpy(&sums.back(), &totals, sizeof totals);  // they travel with the planes
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), kSums * static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                d.communicator());
  MPI_Allreduce(MPI_IN_PLACE, extremes, 3, MPI_DOUBLE, MPI_MAX, d.communicator());
  std::memcpy(&totals, &sums.back(), sizeof totals);
  sums.pop_back();

  PlaneSums planes;
  planes.axis = axis;
  planes.spacing = units.spacing();
  const double cells =
      static_cast<double>(d.cells()[0]) * d.cells()[1] * d.cells()[2] / static_cast<double>(sums.size());
  for (const Sums& s : sums) {
    planes.flux.push_back(units.velocity_to_si(Vec3(s.flux[0], s.flux[1], s.flux[2]) / cells));
    planes.solid_flux.push_back(
        units.velocity_to_si(Vec3(s.solid_flux[0], s.solid_flux[1], s.solid_flux[2]) / cells));
    planes.open_share.push_back(s.open / cells);
    planes.pressure.push_back(s.open > 0 ? units.density_lattice_to_pressure(1 + s.pressure / s.open) : 0);
  }
  const double cell_mass = units.density() * std::pow(units.spacing(), 3);
  planes.fluid_mass = cell_mass * totals.mass;
  planes.stored_mass = cell_mass * totals.stored;
  planes.fluid_kinetic_energy = 0.5 * cell_mass * totals.energy * std::pow(units.velocity_to_si(1.), 2);
  planes.extremes = {std::sqrt(extremes[0]), -extremes[2], extremes[1], true};
  return planes;
}

Vec3 PlaneSums::superficial_velocity(std::size_t begin, std::size_t end) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = begin; i < end; ++i) sum += flux[i] - solid_flux[i];
  return sum / static_cast<double>(std::max<std::size_t>(1, end - begin));
}

double PlaneSums::porosity(std::size_t begin, std::size_t end) const {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += open_share[i];
  return sum / static_cast<double>(std::max<std::size_t>(1, end - begin));
}

double PlaneSums::pressure_at(double height) const {
  if (planes() == 1) return pressure[0];
  const double position = height / spacing - 0.5, last = static_cast<double>(planes() - 2);
  const auto below = static_cast<std::size_t>(std::clamp(std::floor(position), 0., last));
  const double share = position - static_cast<double>(below);
  return (1 - share) * pressure[below] + share * pressure[below + 1];
}

double hydraulic_gradient(const PlaneSums& planes, double low, double high, double pressure_gradient,
                          double specific_weight) {
  const double drop = planes.pressure_at(low) - planes.pressure_at(high);
  return (drop / (high - low) + pressure_gradient) / specific_weight;
}

}  // namespace suffuse::coupling
