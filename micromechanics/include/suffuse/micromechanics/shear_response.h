#pragma once

#include <array>
#include <optional>
#include <vector>

#include "suffuse/micromechanics/microscale_verdicts.h"

namespace suffuse::micromechanics {

/// A sample on its way through a drained shear test, one element a sample in time; columns that are not known
/// are empty. Strains in compression positive, fractions; stresses in Pa.
struct ShearSeries {
  std::vector<double> axial_strain, mean_stress, deviator;  ///< always there; axial strain grows
  std::vector<double> volumetric_strain, void_ratio;
  std::vector<double> coordination, fine_coordination, coarse_coordination;  ///< Z, Z_fc (eq 5.8), Z_cc (5.9)
  std::vector<double> stress_reduction;                                      ///< α
  std::vector<double> sliding_share;

  std::array<std::vector<double>*, 10> columns() {
    return {&axial_strain,     &mean_stress,  &deviator,          &volumetric_strain,
            &void_ratio,       &coordination, &fine_coordination, &coarse_coordination,
            &stress_reduction, &sliding_share};
  }
};

struct ShearSettings {
  double window = 0.002;    ///< axial strain over which everything but void ratios is averaged
  double constant = 0.02;   ///< share of α0 within which α is constant: end of stage 1
  double level = 0.05;      ///< share of the range of ε_v within which the volume is constant
  double at_the_end = 0.9;  ///< a volume that is constant only from this share of the strain on is not
};

/// Of α (section 5.3.6, Figure 5.8): stage 1 lasts until α leaves its band about α0 for good or the stress
/// ratio peaks, stage 2 until the stress ratio peaks, stage 3 to the end.
struct StressReductionStages {
  double start = 0, after_first = 0, at_peak = 0, end = 0;  ///< α at the limits of the stages
  double strain_first = 0;                                  ///< axial strain at which stage 1 ends
  std::optional<double> ratio_first;                        ///< q/p' there
};

struct FabricState {
  FabricCase fabric = FabricCase::overfilled;
  double axial_strain = 0;  ///< from here on
};

/// What chapter 5 reads off its curves. Means are moving ones over ShearSettings::window. Where p' is not
/// positive (a sample that grains no longer hold together) q/p' is not defined, and such samples are no peak;
/// without any other there is none, and no stages.
struct ShearResponse {
  std::optional<double> initial_void_ratio;          ///< e_0
  double peak_deviator = 0;                          ///< q_peak, Pa
  std::optional<double> strain_at_peak, peak_ratio;  ///< of q/p'
  double end_strain = 0;
  std::optional<double> end_ratio;                  ///< q/p' at the end
  std::optional<double> end_volumetric;             ///< ε_v at the end
  std::optional<double> strain_of_constant_volume;  ///< none: not reached
  std::optional<double> coordination_start, coordination_least, coordination_end;
  std::optional<double> coordination_drop;  ///< 1 − Z_least/Z_start; none if Z_start is 0
  std::optional<double> coarse_start, coarse_least, coarse_end;  ///< Z_cc
  std::optional<StressReductionStages> stages;
  std::vector<FabricState> fabrics;       ///< in the order of the strain
  std::optional<double> strain_unstable;  ///< from which Z ≤ 1 or α ≤ 0.5 to the end; none: stable at the end
  std::optional<double> sliding_most, strain_of_most_sliding, sliding_end;
};

/// Throws UserError (`who` first) where a series has fewer than three samples, columns of other lengths, or
/// an axial strain that does not grow past the window.
ShearResponse shear_response(const ShearSeries& series, const ShearSettings& settings = {},
                             const char* who = "shear");

}  // namespace suffuse::micromechanics
