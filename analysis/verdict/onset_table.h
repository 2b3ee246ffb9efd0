#pragma once

#include <optional>
#include <string>

#include "verdict/fluidisation_layers.h"

namespace suffuse::analysis {

/// What else of the run the onset table needs.
struct OnsetOfRun {
  std::optional<double> variance;  ///< S² of the layers' void ratios (eq 6.1), without the floor's layer
  std::optional<double> gradient;  ///< of the bed as it begins to move
  std::optional<double> lowest_gradient;  ///< the lowest layer's own at that time
  bool thesis_soil = false;               ///< print the thesis's numbers beside
};

/// The thesis's section 6.5 on one page: each of its quantities at rest and at the last snapshot before the
/// bed moves, of the top layer, the lowest one and all of them, with the thesis's numbers where the soil is
/// its own. CSV of quantity,symbol,layer,at_rest,at_onset,thesis_at_rest,thesis_at_onset,section; empty where
/// not known.
std::string onset_table(const LayerResults& results, const OnsetOfRun& run);

}  // namespace suffuse::analysis
