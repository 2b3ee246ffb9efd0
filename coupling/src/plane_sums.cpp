#include "suffuse/coupling/plane_sums.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace suffuse::coupling {

namespace {

/// What is summed for each plane, lattice units.
struct Sums {
  double flux[3], solid_flux[3], room, open, pressure;
};
constexpr int kSums = sizeof(Sums) / sizeof(double);

/// Over all cells: mass, twice the kinetic energy, deviation from rest, momentum of the populations.
struct Totals {
  double mass, energy, stored, momentum[3], momentum_magnitude;
};
static_assert(sizeof(Totals) <= sizeof(Sums));

}  // namespace

PlaneSums plane_sums(const MappedScene& scene, int axis) {
  const CoupledSimulation& simulation = scene.simulation();
  const lbm::Fluid& fluid = simulation.fluid();
  const lbm::Units& units = simulation.units();
  const lbm::Decomposition& d = fluid.decomposition();
  const auto along = static_cast<std::size_t>(axis);
  std::vector<Sums> sums(static_cast<std::size_t>(d.cells()[along]) + 1, Sums{});
  Totals totals{};
  double extremes[4] = {0, -1e300, -1e300,
                        0};  // squared speed, density, -density, anything that is no number
  const lbm::StoredMomentum stored = simulation.for_each_point(
      [&](const lbm::Index3& cell, const lbm::FluidPoint& point, double solid_fraction) {
        const double open = 1 - solid_fraction;
        const Vec3 solid = simulation.solid_flux(cell);
        Sums& plane = sums[static_cast<std::size_t>(cell[along])];
        for (int a = 0; a < 3; ++a) {
          plane.flux[a] += point.velocity[a];
          plane.solid_flux[a] += solid[a];
        }
        plane.room += fluid.is_closed(cell) ? 0 : 1;
        plane.open += open;
        plane.pressure += open * (point.density - 1);
        // Means of a cell that grains share hold their flux: the water's own speed is that of the rest.
        const Vec3 water = simulation.method() != nullptr && open > 0 ? Vec3((point.velocity - solid) / open)
                                                                      : point.velocity;
        const double speed_squared = water.squaredNorm();
        // Elsewhere than on the lattice a density is but another word for the pressure, and there is no
        // sound.
        const double density = simulation.method() != nullptr ? 1 : point.density;
        totals.mass += open * density;
        totals.energy += open * density * speed_squared;
        totals.stored += density - 1;
        if (fluid.is_solid(cell)) return;
        if (!std::isfinite(density) || !std::isfinite(speed_squared)) extremes[3] = 1;
        extremes[0] = std::max(extremes[0], simulation.method() != nullptr ? 0 : speed_squared);
        extremes[1] = std::max(extremes[1], density);
        extremes[2] = std::max(extremes[2], -density);
      });
  std::copy_n(stored.sum.data(), 3, totals.momentum);
  totals.momentum_magnitude = stored.magnitude;
  std::memcpy(&sums.back(), &totals, sizeof totals);  // they travel with the planes
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), kSums * static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                d.communicator());
  MPI_Allreduce(MPI_IN_PLACE, extremes, 4, MPI_DOUBLE, MPI_MAX, d.communicator());
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
    planes.room.push_back(s.room / cells);
    planes.open_share.push_back(s.open / cells);
    planes.pressure.push_back(s.open > 0 ? units.density_lattice_to_pressure(1 + s.pressure / s.open) : 0);
  }
  const double cell_mass = units.density() * std::pow(units.spacing(), 3);
  planes.fluid_mass = cell_mass * totals.mass;
  planes.stored_mass = cell_mass * totals.stored;
  planes.fluid_kinetic_energy = 0.5 * cell_mass * totals.energy * std::pow(units.velocity_to_si(1.), 2);
  planes.extremes = {
      std::sqrt(extremes[0]),
      -extremes[2],
      extremes[1],
      extremes[3] == 0,
      totals.stored,
      {Vec3(totals.momentum[0], totals.momentum[1], totals.momentum[2]), totals.momentum_magnitude}};
  return planes;
}

std::size_t PlaneSums::first_with_room() const {
  std::size_t plane = 0;
  while (plane + 1 < planes() && room[plane] == 0) ++plane;
  return plane;
}

std::size_t PlaneSums::end_of_room() const {
  std::size_t end = planes();
  while (end > 1 && room[end - 1] == 0) --end;
  return end;
}

double PlaneSums::room_below(double height) const {
  double behind_walls = 0;
  for (std::size_t i = 0; i < planes(); ++i) {
    const double low = spacing * static_cast<double>(i), part = std::clamp(height - low, 0., spacing);
    behind_walls += (1 - room[i]) * part;
  }
  return height - behind_walls;
}

Vec3 PlaneSums::superficial_velocity(std::size_t begin, std::size_t end) const {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (std::size_t i = begin; i < end; ++i) {
    sum += flux[i] - solid_flux[i];
    area += room[i];
  }
  return area > 0 ? Vec3(sum / area) : Vec3::Zero();
}

double PlaneSums::porosity(std::size_t begin, std::size_t end) const {
  double sum = 0, all = 0;
  for (std::size_t i = begin; i < end; ++i) {
    sum += open_share[i];
    all += room[i];
  }
  return all > 0 ? sum / all : 0;
}

double PlaneSums::pressure_at(double height) const {
  const std::size_t first = first_with_room(), end = end_of_room();
  if (end - first == 1) return pressure[first];
  const double position = height / spacing - 0.5;
  const auto below = static_cast<std::size_t>(
      std::clamp(std::floor(position), static_cast<double>(first), static_cast<double>(end - 2)));
  const double share = position - static_cast<double>(below);
  return (1 - share) * pressure[below] + share * pressure[below + 1];
}

double hydraulic_gradient(const PlaneSums& planes, double low, double high, double pressure_gradient,
                          double specific_weight) {
  const double drop = planes.pressure_at(low) - planes.pressure_at(high);
  return (drop / (high - low) + pressure_gradient) / specific_weight;
}

}  // namespace suffuse::coupling
