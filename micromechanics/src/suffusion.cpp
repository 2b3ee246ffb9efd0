#include "suffuse/micromechanics/suffusion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace suffuse::micromechanics {

namespace {

bool changed_inside(const SuffusionState& first, const SuffusionState& now) {
  for (std::size_t layer = 0; layer < first.fines_share.size(); ++layer) {
    const double before = first.fines_share[layer];
    if (before > 0 && std::abs(now.fines_share[layer] / before - 1) > kInsideChange) return true;
  }
  return false;
}

/// 0 where the water stands still or flows back.
double steepest_over_mean(const SuffusionState& state) {
  const auto& layers = state.layer_gradient;
  if (layers.empty()) return 0;
  const double mean = std::accumulate(layers.begin(), layers.end(), 0.) / static_cast<double>(layers.size());
  return mean > 0 ? *std::max_element(layers.begin(), layers.end()) / mean : 0;
}

}  // namespace

SuffusionOnset suffusion_onset(std::span<const SuffusionState> states,
                               std::span<const double> eroded_shares) {
  SuffusionOnset onset;
  onset.eroded.resize(eroded_shares.size());
  for (std::size_t n = 0; n < states.size(); ++n) {
    const SuffusionState& state = states[n];
    if (!onset.inside && changed_inside(states.front(), state)) onset.inside = state.gradient;
    for (std::size_t k = 0; k < eroded_shares.size(); ++k)
      if (!onset.eroded[k] && state.eroded_share >= eroded_shares[k]) onset.eroded[k] = state.gradient;
    if (n >= states.size() / 10)
      onset.steepest_layer = std::max(onset.steepest_layer, steepest_over_mean(state));
  }
  return onset;
}

}  // namespace suffuse::micromechanics
