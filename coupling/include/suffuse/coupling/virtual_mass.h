#pragma once

#include <optional>

#include "suffuse/lbm/partial_solids.h"

namespace suffuse::coupling {

/// How much of the fluid's answer to a grain's motion is foreseen. The fluid answers a sudden change of a
/// sphere's velocity with C m_f times that change, but only in the steps after: the load of a fluid step,
/// which follows from the velocities before it, is held until the next. A light grain runs away from that,
/// and any grain that swings on its contacts about once a step is pushed by it
/// (docs/decisions/virtual-mass.md). So within the step a drag acts towards the velocity u_n at its
/// beginning,
///
///   m dv/dt = F - c (v - u_n) + r W/dt,   W' = (1 - r) W + integral of c (v - u_n),
///
/// and the same with moments of inertia; c is what holds a free grain back over the step as much as an
/// inertia Cv m_f would (virtual_drag). What it takes, W, the grain gets back, a share r = kReturnedShare a
/// step: grain and fluid keep their momentum, and a motion that lasts for many steps does not change.
struct VirtualMassRule {
  /// The same Cv for translation and rotation of every grain (0: none); otherwise the estimate of C, for the
  /// grains that need it.
  std::optional<double> coefficient;
  double fluid_density = 1000;  ///< kg/m^3
  double relaxation_time = 1;
  double spacing = 0;  ///< m
  lbm::PartialSolidSettings cells;
};

/// Cv m_f and its moment.
struct VirtualInertia {
  double mass = 0;    ///< kg
  double moment = 0;  ///< kg m^2
};

/// What is given back lags behind and pushes slow vibrations on, the more of it the more: 0.1 leaves light
/// beds at rest with twice the energy. With 0.02 a sphere of half the water's density starts too slowly.
inline constexpr double kReturnedShare = 0.07;

/// C of a sphere of `radius` cells just after a change of velocity: the potential-flow added mass 1/2, of
/// a sphere half a cell larger since it holds whole cells, Basset's impulse 9 sqrt(nu/pi)/a and Stokes' drag
/// 9 nu/(2 a^2) (docs key: landaulifshitz1987, problem 7 of section 24).
double response_coefficient(double radius, double viscosity);

/// What the cells of a sphere below two cells a diameter can answer in one step, in masses of the displaced
/// fluid: twice the share B of their fluid that the solid takes along (solid_weight), over the solid in them.
/// Much below a cell it is 6 k nu, however small the sphere: a point force, whose fluid is hardly set in
/// motion. Divided by 1 - radius^2, and infinite from radius 1 on: larger spheres set their fluid in motion
/// in the course of some steps, and response_coefficient has it right.
double cell_response_coefficient(double radius, const lbm::PartialSolidSettings& cells,
                                 double relaxation_time);

/// The same for rotation, in moments of inertia of the displaced fluid: 10 sqrt(nu/pi)/a + 15 nu/a^2.
double rotational_response_coefficient(double radius, double viscosity);

/// Of an answer C m_f the part beyond this share of a grain's mass is foreseen. A grain follows the rest by
/// itself, and what need not be foreseen is better left: with 0 beds of quartz tremble at rest, with 0.5
/// those whose contacts rebound at 0.95 (docs/decisions/virtual-mass.md).
inline constexpr double kSafeResponse = 0.38;

/// C m_f/m of a sphere of `radius` (m) and `mass` (kg), translation or rotation, whichever is larger.
double virtual_mass_number(const VirtualMassRule& rule, double radius, double mass);

/// Of a sphere of `radius` (m) and `mass` (kg): by the smaller of response_coefficient and
/// cell_response_coefficient, the latter m_f/m times for grains that are lighter than the fluid, less
/// kSafeResponse of the mass.
VirtualInertia virtual_inertia(const VirtualMassRule& rule, double radius, double mass);

/// Drag (kg/s, kg m^2/s) that holds a free grain of inertia `own` back over a fluid step as much as `added`
/// would: 2 added/dt where the grain makes one step of its own meanwhile, which is implicit at its middle;
/// with more of them own x/dt, (1 - exp(-x))/x = own/(own + added), within 2 %.
double virtual_drag(double added, double own, int substeps, double fluid_step);

}  // namespace suffuse::coupling
