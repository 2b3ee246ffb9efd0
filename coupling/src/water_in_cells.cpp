// What a coupled simulation tells of its water and grains cell by cell, whoever computes the water.
#include <fmt/format.h>
#include <mpi.h>

#include "suffuse/common/error.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/lbm/health.h"

namespace suffuse::coupling {

double CoupledSimulation::solid_coefficient(const lbm::Index3& cell) const {
  const lbm::Index3& lo = fluid_.decomposition().local_box().lo;
  const std::ptrdiff_t at =
      cell[0] - lo[0] + cells_.row_pitch * (cell[1] - lo[1]) + cells_.plane_pitch * (cell[2] - lo[2]);
  if (!(cells_.fraction[at] > 0)) return 0;
  const double k = static_cast<double>(cells_.strength[at]) / static_cast<double>(cells_.fraction[at]);
  return settings_.solids.cells.own_coefficients ? k : k * settings_.solids.cells.coefficient;
}

double CoupledSimulation::overlap() const {
  double sum = mapping_.overlap();
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, fluid_.decomposition().communicator());
  return sum;
}

lbm::StoredMomentum CoupledSimulation::for_each_point(const lbm::Fluid::PointVisitor& visit) const {
  if (!method_) return fluid_.for_each_point(visit);
  lbm::for_each_cell(fluid_.decomposition().local_box(), [&](int x, int y, int z) {
    const WaterCell water = method_->at({x, y, z});
    const lbm::FluidPoint point{units_.pressure_to_density_lattice(water.pressure),
                                units_.velocity_to_lattice(water.flux)};
    visit({x, y, z}, point, water.solid_fraction);
  });
  return {};
}

double CoupledSimulation::solid_fraction(const lbm::Index3& cell) const {
  return method_ ? method_->at(cell).solid_fraction : fluid_.solid_fraction(cell);
}

Vec3 CoupledSimulation::solid_flux(const lbm::Index3& cell) const {
  return method_ ? units_.velocity_to_lattice(method_->at(cell).solid_flux) : mapping_.solid_flux(cell);
}

lbm::FluidExtremes CoupledSimulation::extremes() const {
  if (!method_) return fluid_.extremes();
  return {units_.velocity_to_lattice(method_->largest_speed()), 1, 1, method_->is_finite(), 0, {}};
}

void CoupledSimulation::require_stable(const lbm::FluidExtremes& extremes, double largest_mach,
                                       const std::string& who) const {
  if (!method_) return lbm::require_stable(extremes, units_, time_si(), largest_mach, who);
  if (!extremes.finite)
    throw_lost_run({who, fmt::format("flow at {:.5g} s", time_si()), "not a number", "stay finite",
                    fmt::format("use a timestep below {:.3g} s", 0.5 * units_.time_step())});
}

std::string CoupledSimulation::health_text(const lbm::FluidExtremes& extremes) const {
  if (!method_) return lbm::health_text(extremes);
  return fmt::format("water up to {:.3g} m/s", units_.velocity_to_si(extremes.largest_speed));
}

}  // namespace suffuse::coupling
