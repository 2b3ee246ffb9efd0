#pragma once

#include "suffuse/common/linear_algebra.h"

/// Forces of the viscous film in a narrow gap between two spheres, or a sphere and a plane, in excess of what
/// a lattice resolves. Pure: no LIGGGHTS, no MPI. SI units.
///
/// With n from the first to the second sphere, gap h, radii a₁ and a₂, R = a₁a₂/(a₁+a₂), and
///
///     v_n = (v₂ − v₁)·n                                     approach
///     u   = [v₂ − v₁ − (l₁ω₁ + l₂ω₂) × n] without its normal part,  l = a + h/2     slip at mid-gap
///     w   = (ω₁ − ω₂) × n                                   rolling
///
/// the film dissipates the power  K_n v_n² + K_u u² + 2 K_uw u·w + K_w w²,  and forces and torques are the
/// derivatives of half of it. So all four coefficients of the leading (singular) order of `jeffrey1984` are
/// met — X^A; Y^A, Y^B, Y^C in three numbers, since a film feels relative motion alone — and a rigid motion
/// of the pair costs nothing at any gap, linear and angular momentum are conserved (F₁ + F₂ = 0,
/// T₁ + T₂ + (x₂ − x₁) × F₂ = 0) and energy is only lost. Twist about n has no singular part (X^C).
///
/// Forces on a sphere near a plane, a₂ → ∞, are those of `goldman1967`; the squeeze and tangential parts that
/// particle codes use (`simeonov2012`) are special cases.
namespace suffuse::lubrication {

/// Where the film acts: coefficients are their leading-order form minus its value at `outer`, hence zero from
/// there on, and keep the value at `inner` below that gap (roughness; also while spheres overlap).
struct Film {
  double viscosity = 0;  ///< dynamic, Pa s
  double outer = 0;      ///< gap from which on the lattice resolves the film, m; 2/3 of a cell (`nguyen2002`)
  double inner = 0;      ///< smallest gap that counts, m; 0 < inner < outer
};

struct Resistance {
  double squeeze = 0;  ///< K_n  = 6π μ R² (1/h − 1/outer), N s/m
  double slide = 0;    ///< K_u  = 8/5 π μ R (2 − 3 R²/(a₁a₂)) ln(outer/h), N s/m
  double couple = 0;   ///< K_uw = 12/5 π μ R² (a₂ − a₁)/(a₁ + a₂) ln(outer/h), N s
  double roll = 0;     ///< K_w  = 24/5 π μ R³ ln(outer/h), N m s
};

/// Coefficients at a gap (m). The second radius may be infinite: a plane. K_u K_w − K_uw² = 48/5 (π μ R² ln)²
/// for every ratio of radii, so that sliding always costs power.
Resistance film_resistance(const Film& film, double first_radius, double second_radius, double gap);

struct Body {
  double radius = 0;                     ///< m; infinite: a plane, whose angular velocity is not looked at
  double inverse_mass = 0;               ///< 1/kg, for the bound below; 0: held
  double inverse_moment = 0;             ///< 1/(kg m²)
  Vec3 velocity = Vec3::Zero();          ///< of the centre, m/s; of a plane: of its surface
  Vec3 angular_velocity = Vec3::Zero();  ///< 1/s
};

/// All zero when the gap is `outer` or more.
struct PairLoads {
  Vec3 force_on_first = Vec3::Zero();   ///< N; on the second: its negative
  Vec3 torque_on_first = Vec3::Zero();  ///< N m, about the centre
  Vec3 torque_on_second = Vec3::Zero();
  double power = 0;      ///< dissipated, W; never negative
  bool bounded = false;  ///< by the limit of film_loads
};

/// Forces and torques of one film; `normal` is the unit vector from the first to the second body.
///
/// Bounded so that an explicit step of `time_step` (s) cannot reverse a relative motion: the squeeze
/// coefficient to the inverse of dt (1/m₁ + 1/m₂), and the three others, together, so that the largest
/// eigenvalue of dt × resistance × inverse inertia is 1. A body in z films at once that gives each of them
/// 1/z of its mass and moment (inverse_mass = z/m) makes the same hold for all films together: the sum of the
/// pairs' quadratic forms is then at most M/dt, so the kinetic energy cannot rise, whatever the packing.
PairLoads film_loads(const Film& film, const Body& first, const Body& second, const Vec3& normal, double gap,
                     double time_step);

}  // namespace suffuse::lubrication
