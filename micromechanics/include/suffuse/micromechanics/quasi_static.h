#pragma once

namespace suffuse::micromechanics {

/// Elastic material of the grains, SI.
struct GrainMaterial {
  double youngs_modulus = 0;  ///< E, Pa
  double poissons_ratio = 0;  ///< ν
  double density = 0;         ///< of the solid, kg/m³
};

/// Inertial number I = |ε̇| d √(ρ/p') (da Cruz et al. 2005; thesis eq 3.17), dimensionless. Below 7.9e-5 a
/// compression is quasi-static (Perez et al. 2016). `strain_rate` 1/s, `diameter` m (state which mean), `density` of the
/// solid kg/m³, `pressure` p' Pa, > 0.
struct InertialState {
  double strain_rate = 0;
  double diameter = 0;
  double density = 0;
  double pressure = 0;
};

/// 0 where the pressure is not positive: no contacts, no inertial number.
double inertial_number(const InertialState& state);

/// E* of two equal grains, E/(2(1 − ν²)), Pa (thesis eq 3.8).
double equivalent_youngs_modulus(const GrainMaterial& material);

/// Time for a Rayleigh wave to cross the smallest grain: π R √(ρ/G)/(0.1631ν + 0.8766), s (`thornton1991`).
double rayleigh_time(const GrainMaterial& material, double radius);

/// Mean contact force at a mean stress p': F = π d² p'/(Z(1 − n)), N (Rumpf 1970, equal spheres). Exact for the simple
/// cubic (4R²p') and face-centred cubic (√2 R²p') arrays.
struct PackingState {
  double mean_stress = 0;     ///< p', Pa
  double coordination = 0;    ///< Z, > 0
  double solid_fraction = 0;  ///< 1 − n, > 0
};
double mean_contact_force(double diameter, const PackingState& state);

/// Tangent stiffness dF/dδ of a Hertz contact of two equal spheres under a normal force, N/m:
/// K = 2E*√(R*δ), δ = (3F/(4E*√R*))^(2/3), R* = R/2 (thesis eqs 3.6–3.8, 3.12).
double hertz_tangent_stiffness(const GrainMaterial& material, double radius, double normal_force);

/// Overlap δ of the same contact, m.
double hertz_overlap(const GrainMaterial& material, double radius, double normal_force);

/// Limits of the DEM time step for the smallest grain, s. They need a stiffness, and Hertz's depends on the force, so
/// on the state of the packing.
struct TimeStepLimits {
  double cundall = 0;    ///< 2√(m/K) (thesis eq 3.3)
  double osullivan = 0;  ///< 0.22√(m/K) (thesis eq 3.4)
  double rayleigh = 0;   ///< rayleigh_time
};
TimeStepLimits time_step_limits(const GrainMaterial& material, double radius, const PackingState& state);

/// κ = (E*/p')^(2/3): how stiff the grains are against the confinement (`roux2002`). At κ ≥ 1000 results hardly depend
/// on the stiffness; the overlap is of the order of d/κ.
double stiffness_number(const GrainMaterial& material, double mean_stress);

}  // namespace suffuse::micromechanics
