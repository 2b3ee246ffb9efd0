#pragma once

namespace suffuse::micromechanics {

/// Water (or another liquid) and what pulls it.
struct SeepageFluid {
  double density = 1000;              ///< kg/m³
  double kinematic_viscosity = 1e-6;  ///< m²/s
  double gravity = 9.81;              ///< m/s²
};

/// Terzaghi's critical gradient i_cr = γ'/γ_w = (ρ_s/ρ_f − 1)(1 − n) (thesis eq 2.8; key: terzaghi1943).
double critical_gradient(double porosity, double grain_density, const SeepageFluid& fluid = {});

/// Skempton and Brogan's for the fines of an internally unstable soil, α γ'/γ_w (key: skemptonbrogan1994); α
/// up to 1 matters: above it the soil as a whole lifts first, and 1 is taken.
double critical_gradient_of_fines(double porosity, double grain_density, double stress_reduction,
                                  const SeepageFluid& fluid = {});

/// What rests on a layer.
struct LayerStress {
  double stress = 0;     ///< σ'_t, Pa
  double thickness = 0;  ///< Δz, m
};
/// Li and Fannin's envelope for upward flow (key: lifannin2012), of a layer of thickness Δz under the
/// effective stress σ'_t: i_cr = α [σ'_t/(γ_w Δz) + γ'/γ_w], α up to 1; Terzaghi's heave under a surcharge
/// for α = 1. The thesis shows it without a formula. Printed with the mean stress in the layer at the onset,
/// σ'_m = σ'_t + (γ' − i γ_w)Δz/2, it is i_cr = α/(1 − α/2) [σ'_m/(γ_w Δz) + γ'/(2γ_w)].
double critical_gradient_by_top_stress(double porosity, double grain_density, double stress_reduction,
                                       const LayerStress& layer, const SeepageFluid& fluid = {});

/// Hydraulic conductivities K, m/s.
///
/// Hazen: K = C d10², C = 1e4/(m s) (K in cm/s = 100 d10² in cm²; key: hazen1892). Sands with d10 of 0.1 to 3
/// mm, C_u < 5.
double conductivity_hazen(double d10, double coefficient = 1e4);
/// Carman and Kozeny: K = (g/ν) d² n³/(180 (1 − n)²), d Sauter's size (key: carman1939). Laminar flow.
double conductivity_carman_kozeny(double diameter, double porosity, const SeepageFluid& fluid = {});
/// Chapuis: K in cm/s = 2.4622 [d10² e³/(1 + e)]^0.7825, d10 in mm (key: chapuis2004), for water at 20 °C.
double conductivity_chapuis(double d10, double porosity);

/// Superficial velocity at a gradient by Ergun (thesis eqs 3.42, 6.2; key: ergun1952), m/s: the root of
/// ρ_f g i = 150 μ U (1 − n)²/(d² n³) + 1.75 ρ_f U² (1 − n)/(d n³).
double velocity_ergun(double gradient, double diameter, double porosity, const SeepageFluid& fluid = {});

/// The gradient at a superficial velocity by the same law.
double gradient_ergun(double velocity, double diameter, double porosity, const SeepageFluid& fluid = {});

/// Least superficial velocity of fluidisation by Wen and Yu, m/s: U d/ν = √(33.7² + 0.0408 Ar) − 33.7 with Ar
/// = d³ (ρ_s/ρ_f − 1) g/ν² (key: wenyu1966); knows no porosity, scatters by a third.
double minimum_fluidisation_wen_yu(double diameter, double grain_density, const SeepageFluid& fluid = {});

}  // namespace suffuse::micromechanics
