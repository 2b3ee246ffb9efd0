#pragma once

#include <optional>
#include <span>
#include <vector>

namespace suffuse::micromechanics {

/// What a sample under seepage was like at one moment.
struct SuffusionState {
  double gradient = 0;                 ///< applied; negative where it drives the water down
  double eroded_share = 0;             ///< of all fines, that have left the sample
  std::vector<double> fines_share;     ///< of the solids, by layer
  std::vector<double> layer_gradient;  ///< of the water, by layer
};

/// At which applied gradients a sample began to change, by their magnitudes, up or down: the largest that it
/// had seen by then, which of a ramp is the gradient of that moment.
struct SuffusionOnset {
  /// Where the fines content of a layer that had some has first changed by `kInsideChange` of what it was at
  /// first.
  std::optional<double> inside;
  /// Where so much of all fines had left, for each of the shares that were asked for.
  std::vector<std::optional<double>> eroded;
  /// Largest gradient of a layer over the mean of the layers, after the first tenth of the states, where that
  /// mean is at least `kSteadyShare` of the largest so far (a gradient that swings passes zero): where a
  /// layer clogs it rises.
  double steepest_layer = 0;
};

inline constexpr double kInsideChange = 0.05, kSteadyShare = 0.5;

/// Of states in the order of time, with as many layers each.
SuffusionOnset suffusion_onset(std::span<const SuffusionState> states, std::span<const double> eroded_shares);

}  // namespace suffuse::micromechanics
