#pragma once

#include <vector>

#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// Means over planes of cells across one axis, SI. Element i belongs to the plane of cells i. What lies
/// behind walls is neither pore nor grain: superficial velocities and porosities are those of the room
/// between walls, the other means those of the whole plane.
struct PlaneSums {
  int axis = 2;
  double spacing = 0;              ///< m; plane i is centred at (i + 1/2) spacing above the low corner
  std::vector<Vec3> flux;          ///< volume of fluid and solids together that moves, m^3 per m^2 and s
  std::vector<Vec3> solid_flux;    ///< of it the solids'
  std::vector<double> room;        ///< share of the plane that does not lie behind walls
  std::vector<double> open_share;  ///< share of the plane that solids leave open
  std::vector<double> pressure;    ///< mean over the open part, Pa above the reference; 0 if there is none
  double fluid_mass = 0;           ///< in the open part of all planes, kg
  double stored_mass = 0;  ///< of all populations, those in grains included, beyond rest, kg: conserved
  double fluid_kinetic_energy = 0;  ///< of the open part, J
  lbm::FluidExtremes extremes;      ///< of all cells, lattice units, as Fluid::extremes gives them

  std::size_t planes() const { return flux.size(); }

  /// The planes [first_with_room, end_of_room) have room for water; all of them without walls.
  std::size_t first_with_room() const;
  std::size_t end_of_room() const;
  /// Share of a plane that grains cover.
  double solid_share(std::size_t plane) const { return room[plane] - open_share[plane]; }

  /// Volume of the room below a height above the low corner, per area of the whole plane, m: the height
  /// itself without walls.
  double room_below(double height) const;

  /// Fluid's volume flux (Darcy velocity) averaged over the planes [begin, end), m/s: the flux less the
  /// solids' own, over the area of the room. Zero where there is none.
  Vec3 superficial_velocity(std::size_t begin, std::size_t end) const;
  Vec3 superficial_velocity() const { return superficial_velocity(0, planes()); }

  /// Porosity of the planes [begin, end); zero where there is no room.
  double porosity(std::size_t begin, std::size_t end) const;

  /// Pressure at a height above the low corner (m) along the axis, between the means of the two planes next
  /// to it; beyond the middle of the first and last plane with room it goes on straight.
  double pressure_at(double height) const;
};

/// One sweep over the cells. Collective.
PlaneSums plane_sums(const MappedScene& scene, int axis);

/// -dp/(rho_f g dz) between two heights above the low corner (m), from the fluid-only mean of the pressure in
/// excess of the hydrostatic one (the thesis gives no formula for its local gradient), plus the part that a
/// `pressure_gradient` (Pa/m) drives: a periodic box has no pressure difference of its own.
double hydraulic_gradient(const PlaneSums& planes, double low, double high, double pressure_gradient,
                          double specific_weight);

}  // namespace suffuse::coupling
