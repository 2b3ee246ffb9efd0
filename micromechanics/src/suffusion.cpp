#include "suffuse/micromechanics/suffusion.h"

#include <algorithm>
#include <cmath>

#include "suffuse/micromechanics/fluidisation.h"

namespace suffuse::micromechanics {

namespace {

bool changed_inside(const SuffusionState& first, const SuffusionState& now) {
  for (std::size_t layer = 0; layer < first.fines_share.size(); ++layer) {
    const double before = first.fines_share[layer];
    if (before > 0 && std::abs(now.fines_share[layer] / before - 1) > kInsideChange) return true;
  }
  return false;
}

}  // namespace

SuffusionOnset suffusion_onset(std::span<const SuffusionState> states,
                               std::span<const double> eroded_shares) {
  SuffusionOnset onset;
  onset.eroded.resize(eroded_shares.size());
  double largest = 0, largest_mean = 0;
  for (std::size_t n = 0; n < states.size(); ++n) {
    const SuffusionState& state = states[n];
    largest = std::max(largest, std::abs(state.gradient));
    if (!onset.inside && changed_inside(states.front(), state)) onset.inside = largest;
    for (std::size_t k = 0; k < eroded_shares.size(); ++k)
      if (!onset.eroded[k] && state.eroded_share >= eroded_shares[k]) onset.eroded[k] = largest;
    const double mean = state.layer_gradient.empty() ? 0 : bed_gradient(state.layer_gradient);
    largest_mean = std::max(largest_mean, std::abs(mean));
    if (n < states.size() / 10 || mean == 0 || std::abs(mean) < kSteadyShare * largest_mean) continue;
    for (const double gradient : state.layer_gradient)  // along the flow, up or down
      onset.steepest_layer = std::max(onset.steepest_layer, gradient / mean);
  }
  return onset;
}

}  // namespace suffuse::micromechanics
