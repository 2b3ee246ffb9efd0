#pragma once

namespace suffuse::micromechanics {

/// Two spheres in Hertz contact (thesis eqs 3.6–3.8).
struct HertzPair {
  double effective_modulus = 0;  ///< E*, Pa; E/(2(1 − ν²)) for like grains
  double effective_radius = 0;   ///< R*, m; half the radius for equal grains
};

/// Force 4/3 E*√(R*δ) δ at an overlap δ ≥ 0 (m), N.
double hertz_force(const HertzPair& pair, double overlap);

/// Tangent stiffness dF/dδ = 2E*√(R*δ) at an overlap δ ≥ 0 (m) (eq 3.12), N/m.
double hertz_stiffness_at(const HertzPair& pair, double overlap);

}  // namespace suffuse::micromechanics
