#pragma once

/// Time-step limits of a Hertz–Mindlin DEM and the numbers that say how stiff a packing is.
/// Sources: thesis eqs 3.3–3.8 and 3.12 (Cundall & Strack 1979; O'Sullivan 2011).
namespace suffuse::micromechanics {

/// One grain material and the size that decides the step.
struct GrainMaterial {
  double youngs_modulus = 0;  ///< E, Pa
  double poisson_ratio = 0;   ///< ν
  double density = 0;         ///< ρ, kg/m³
  double diameter = 0;        ///< of the smallest grain, m
};

/// Effective modulus of two like grains, E* = E / (2(1 − ν²)) (eq 3.8), Pa.
double effective_modulus(const GrainMaterial& material);

/// Stiffness number κ = (E*/p')^(2/3): typical diameter over typical overlap at mean stress p' (Pa).
double stiffness_number(const GrainMaterial& material, double mean_stress);

/// Time for a Rayleigh wave to travel half round the smallest grain, π r √(ρ/G) / (0.1631 ν + 0.8766), s.
double rayleigh_time(const GrainMaterial& material);

/// Tangent Hertz stiffness S_n = 2 E* √(R* δ) (eq 3.12) of two like grains at the overlap δ = d/κ, N/m.
double contact_stiffness(const GrainMaterial& material, double mean_stress);

/// √(m/K) of the smallest grain at mean stress p', s. Eq 3.3 allows twice this, eq 3.4 0.22 of it.
double oscillation_time(const GrainMaterial& material, double mean_stress);

inline constexpr double kSingleSpringFactor = 2.0;  ///< eq 3.3
inline constexpr double kPackingFactor = 0.22;      ///< eq 3.4

}  // namespace suffuse::micromechanics
