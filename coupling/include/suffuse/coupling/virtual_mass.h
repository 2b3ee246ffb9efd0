#pragma once

#include <optional>

namespace suffuse::coupling {

/// How much inertia of fluid is added to both sides of a grain's equations of motion,
///
///   (m + Cv m_f) a = F + Cv m_f a_before   (a_before: mean acceleration over the last fluid step),
///
/// and the same with moments of inertia. The exact motion does not change, but the explicit exchange does:
/// within one step the fluid answers a sudden change of a sphere's velocity with C m_f times that change. A
/// grain then follows only if C m_f < m; with a virtual mass it does as soon as Cv > (C - m/m_f)/2.
struct VirtualMassRule {
  /// The same Cv for translation and rotation of every grain (0: none); otherwise the estimate of C, for the
  /// grains that need it.
  std::optional<double> coefficient;
  double fluid_density = 1000;  ///< kg/m^3
  double viscosity = 0;         ///< lattice units, (tau - 1/2)/3
  double spacing = 0;           ///< m
};

struct VirtualInertia {
  double mass = 0;    ///< kg
  double moment = 0;  ///< kg m^2
};

/// C of a sphere of `radius` cells in the first step after a change of velocity: the potential-flow added
/// mass 1/2, Basset's impulse 9 sqrt(nu/pi)/a and Stokes' drag 9 nu/(2 a^2) (docs key: landaulifshitz1987,
/// problem 7 of section 24).
double response_coefficient(double radius, double viscosity);

/// The same for rotation, in moments of inertia of the displaced fluid: 10 sqrt(nu/pi)/a + 15 nu/a^2.
double rotational_response_coefficient(double radius, double viscosity);

/// Of a sphere of `radius` (m) and `mass` (kg). The estimate is for a lone sphere and its own volume; dense
/// beds and few cells a diameter answer up to some 2.5 times as much, so grains get it from C m_f > 0.4 m on.
VirtualInertia virtual_inertia(const VirtualMassRule& rule, double radius, double mass);

}  // namespace suffuse::coupling
