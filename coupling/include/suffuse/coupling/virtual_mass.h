#pragma once

#include <optional>

#include "suffuse/lbm/partial_solids.h"

namespace suffuse::coupling {

/// How much inertia of fluid is added to both sides of a grain's equations of motion,
///
///   (m + Cv m_f) a = F + Cv m_f a_before   (a_before: running mean of the acceleration, kPredictionRate),
///
/// and the same with moments of inertia (docs key: schwarz2015). The exact motion changes by a lag of some
/// steps only, but the explicit exchange does not: the fluid answers a sudden change of a sphere's velocity
/// with C m_f times that change, part of it at once and part in the steps after. A light grain follows only
/// with a virtual mass of about that size, and only if a_before is slower than the answer.
struct VirtualMassRule {
  /// The same Cv for translation and rotation of every grain (0: none); otherwise the estimate of C, for the
  /// grains that need it.
  std::optional<double> coefficient;
  double fluid_density = 1000;  ///< kg/m^3
  double relaxation_time = 1;
  double spacing = 0;  ///< m
  lbm::PartialSolidSettings cells;
};

struct VirtualInertia {
  double mass = 0;    ///< kg
  double moment = 0;  ///< kg m^2
};

/// a_before moves towards the last step's acceleration by this share a step. With 1 (docs key: schwarz2015)
/// spheres of one or two cells at relaxation time 1.5 run away with any virtual mass, at 0.1 times the
/// fluid's density already from relaxation time 0.6 on: the drag of the step before pushes them over.
inline constexpr double kPredictionRate = 0.25;

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

/// Share of a grain's mass from which on the fluid's answer to a change of its velocity, C m_f, is taken over
/// to the grain's side.
inline constexpr double kSafeResponse = 0.4;

/// C m_f/m of a sphere of `radius` (m) and `mass` (kg), translation or rotation, whichever is larger.
double virtual_mass_number(const VirtualMassRule& rule, double radius, double mass);

/// Of a sphere of `radius` (m) and `mass` (kg): by the smaller of response_coefficient and
/// cell_response_coefficient, the latter m_f/m times for grains that are lighter than the fluid. The estimate
/// is for a lone sphere; grains get 1.5 times it from C m_f > 0.4 m on, as neighbours make the fluid's answer
/// stiffer. More would do harm: after a collision a grain goes on being accelerated by what the virtual mass
/// has more than the fluid's answer.
VirtualInertia virtual_inertia(const VirtualMassRule& rule, double radius, double mass);

}  // namespace suffuse::coupling
