#pragma once

/// Time-step limits of a DEM, grain by grain, and the numbers that say how stiff a packing is.
/// Sources: thesis eqs 3.3–3.8 and 3.12 (Cundall & Strack 1979; O'Sullivan 2011); LIGGGHTS's `model hooke`
/// for the linear spring.
namespace suffuse::micromechanics {

/// A grain and its material.
struct GrainMaterial {
  double youngs_modulus = 0;  ///< E, Pa
  double poisson_ratio = 0;   ///< ν
  double density = 0;         ///< ρ, kg/m³; that of the inertia, where densities are scaled
  double diameter = 0;        ///< m
};

/// Effective modulus of two like grains, E* = E / (2(1 − ν²)) (eq 3.8), Pa.
double effective_modulus(const GrainMaterial& material);

/// Mass of a grain, ρ π d³/6, kg.
double grain_mass(const GrainMaterial& grain);

/// Stiffness number κ = (E*/p')^(2/3): typical diameter over typical overlap at mean stress p' (Pa).
double stiffness_number(const GrainMaterial& material, double mean_stress);

/// Time for a Rayleigh wave to travel half round a grain, π r √(ρ/G) / (0.1631 ν + 0.8766), s.
double rayleigh_time(const GrainMaterial& material);

/// Tangent Hertz stiffness S_n = 2 E* √(R* δ) (eq 3.12) of two like grains at the overlap δ = d/κ, N/m.
double contact_stiffness(const GrainMaterial& material, double mean_stress);

/// √(m/K) of a grain at mean stress p', s. Eq 3.3 allows twice this, eq 3.4 0.22 of it.
double oscillation_time(const GrainMaterial& material, double mean_stress);

inline constexpr double kSingleSpringFactor = 2.0;  ///< eq 3.3
inline constexpr double kPackingFactor = 0.22;      ///< eq 3.4

/// A contact of the linear law `model hooke`.
struct HookeContact {
  double effective_modulus = 0;        ///< E* of the two materials, Pa
  double effective_radius = 0;         ///< R* = r₁r₂/(r₁ + r₂), at a wall r, m
  double effective_mass = 0;           ///< m* = m₁m₂/(m₁ + m₂), at a wall m, kg
  double characteristic_velocity = 0;  ///< V of `fix property/global characteristicVelocity`, m/s
};

/// Spring of LIGGGHTS's `model hooke`: k = 16/15 √R* E* (15 m* V²/(16 √R* E*))^(1/5), which stores the
/// energy of an impact at V at the overlap that Hertz's law reaches then, N/m.
double hooke_stiffness(const HookeContact& contact);

/// Half a period of an undamped linear contact, π √(m*/k), s: what a time step has to resolve.
double contact_duration(double effective_mass, double stiffness);

/// Diameter over typical overlap of a packing of linear springs at mean stress p', k/(p' d): the force on a
/// contact is about p' d².
double linear_stiffness_number(double stiffness, double diameter, double mean_stress);

/// Factor on the density of a grain that lifts its critical time t ~ ρ^exponent to a reference,
/// (t_ref/t)^(1/exponent), and 1 for a grain that has it. Of diameters d, with t ~ d √ρ: (d_ref/d)².
double density_factor(double time, double reference, double exponent);

}  // namespace suffuse::micromechanics
