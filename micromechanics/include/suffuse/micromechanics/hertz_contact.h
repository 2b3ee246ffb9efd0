#pragma once

namespace suffuse::micromechanics {

/// Two spheres in Hertz contact (thesis eqs 3.6–3.8).
struct HertzPair {
  double effective_modulus = 0;  ///< E*, Pa; E/(2(1 − ν²)) for like grains
  double effective_radius = 0;   ///< R*, m; half the radius for equal grains
};

/// Overlap δ = (3F/(4E*√R*))^(2/3) at a normal force F ≥ 0 (N), m.
double hertz_overlap(const HertzPair& pair, double normal_force);

/// Tangent stiffness dF/dδ = 2E*√(R*δ) at a normal force (eq 3.12), N/m.
double hertz_tangent_stiffness(const HertzPair& pair, double normal_force);

/// Force 4/3 E*√(R*δ) δ at an overlap δ ≥ 0 (m), N.
double hertz_force(const HertzPair& pair, double overlap);

/// Tangent stiffness 2E*√(R*δ) at an overlap δ ≥ 0 (m), N/m.
double hertz_stiffness_at(const HertzPair& pair, double overlap);

/// State of a packing of equal spheres.
struct PackingState {
  double mean_stress = 0;     ///< p', Pa
  double coordination = 0;    ///< Z, > 0
  double solid_fraction = 0;  ///< 1 − n, > 0
};

/// Mean contact force at a mean stress, F = π d² p'/(Z(1 − n)), N (`rumpf1970`). Exact for the simple cubic
/// (4R²p') and face-centred cubic (√2 R²p') arrays.
double mean_contact_force(double diameter, const PackingState& state);

}  // namespace suffuse::micromechanics
