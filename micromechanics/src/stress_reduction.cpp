#include "suffuse/micromechanics/stress_reduction.h"

#include <cmath>

namespace suffuse::micromechanics {

StressReductionSums stress_reduction_sums(const Packing& packing, SizeSplit split, GrainArm arm) {
  StressReductionSums sums;
  for (const Grain& grain : packing.grains) {
    sums.solid_volume += sphere_volume(grain.radius);
    if (split.is_fine(grain.radius)) sums.fines_volume += sphere_volume(grain.radius);
  }
  for_each_grain_stress(packing, arm, [&](int grain, const Mat3& stress) {
    sums.all_stress.add(stress);
    if (split.is_fine(packing.grains[static_cast<std::size_t>(grain)].radius)) sums.fines_stress.add(stress);
  });
  return sums;
}

StressReduction stress_reduction(const StressReductionSums& sums, double volume) {
  StressReduction result;
  if (sums.solid_volume <= 0 || volume <= 0) return result;
  const Mat3 all = sums.all_stress.matrix();
  const Mat3 fines = sums.fines_stress.matrix();
  result.fines_solid_share = sums.fines_volume / sums.solid_volume;
  result.mean_stress = mean_stress(all) / volume;
  if (sums.fines_volume > 0)
    result.fines_mean_stress = sums.solid_volume / volume * mean_stress(fines) / sums.fines_volume;
  if (result.mean_stress == 0) return result;
  result.shire = result.fines_mean_stress / result.mean_stress;
  result.sufian = mean_stress(fines) / mean_stress(all);
  result.fines_stress_share = mean_stress(fines) / volume / result.mean_stress;
  const double deviator = all(2, 2) - all(0, 0);
  if (std::abs(deviator) > kIsotropyTolerance * std::abs(mean_stress(all)))
    result.beta = (fines(2, 2) - fines(0, 0)) / deviator;
  return result;
}

}  // namespace suffuse::micromechanics
