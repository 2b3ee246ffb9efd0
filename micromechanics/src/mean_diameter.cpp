#include "suffuse/micromechanics/mean_diameter.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "suffuse/micromechanics/coordination.h"

namespace suffuse::micromechanics {

DiameterSums diameter_sums(const Packing& packing) {
  DiameterSums sums;
  for (const Grain& grain : packing.grains) {
    const double volume = sphere_volume(grain.radius);
    sums.grains += 1;
    sums.diameter += 2 * grain.radius;
    sums.volume += volume;
    sums.diameter_volume += 2 * grain.radius * volume;
  }
  return sums;
}

double mean_diameter(const DiameterSums& sums, MeanDiameter which) {
  assert(which != MeanDiameter::d50);
  if (sums.grains <= 0) return 0;
  return which == MeanDiameter::number ? sums.diameter / sums.grains : sums.diameter_volume / sums.volume;
}

double diameter_finer_than(std::span<const double> diameters, double share) {
  if (diameters.empty()) return 0;
  std::vector<double> sorted(diameters.begin(), diameters.end());
  std::sort(sorted.begin(), sorted.end());
  double total = 0;
  for (const double diameter : sorted) total += diameter * diameter * diameter;
  double finer = 0;
  for (const double diameter : sorted) {
    finer += diameter * diameter * diameter;
    if (finer >= share * total) return diameter;
  }
  return sorted.back();
}

}  // namespace suffuse::micromechanics
