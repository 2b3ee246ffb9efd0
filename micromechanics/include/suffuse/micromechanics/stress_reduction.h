#pragma once

#include <optional>

#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/stress.h"

namespace suffuse::micromechanics {

/// What one rank adds to the stress reduction factors.
struct StressReductionSums {
  double fines_volume = 0;  ///< Σ V_p over fines, m³
  double solid_volume = 0;  ///< Σ V_p over all grains, m³
  TensorSum fines_stress;   ///< Σ σ^p V_p over fines, N·m
  TensorSum all_stress;     ///< Σ σ^p V_p over all grains, N·m
};

StressReductionSums stress_reduction_sums(const Packing& packing, SizeSplit split, GrainArm arm);

/// How much of the stress the fines carry (Shire et al. 2014; Sufian et al. 2021; thesis eqs 4.3–4.5 and App.
/// F). Without fines, without stress or without solids every number is 0 and beta undefined.
struct StressReduction {
  double shire = 0;            ///< α = [(1−n) Σ_fines p_p V_p / Σ_fines V_p]/p'
  double sufian = 0;           ///< α = Σ_fines p_p V_p / Σ p_p V_p
  std::optional<double> beta;  ///< Σ_fines (σ_zz − σ_xx)V_p / Σ (σ_zz − σ_xx)V_p; none where the whole is
                               ///< below kIsotropyTolerance of p'
  double fines_stress_share = 0;  ///< (1/V) Σ_fines p_p V_p over p'; the same number as `sufian`
  double fines_solid_share = 0;   ///< Σ_fines V_p / Σ V_p, by volume
  double mean_stress = 0;         ///< p', Pa
  double fines_mean_stress = 0;   ///< p'_f of eq 4.5, Pa
};

/// A deviator below this share of |p'| is what a sample at rest has by chance, and shares of it are noise: a
/// servo holds its stresses to about half a per cent.
inline constexpr double kIsotropyTolerance = 0.01;

/// `volume`: of the sample, voids included, m³, > 0. It cancels in all ratios.
StressReduction stress_reduction(const StressReductionSums& sums, double volume);

}  // namespace suffuse::micromechanics
