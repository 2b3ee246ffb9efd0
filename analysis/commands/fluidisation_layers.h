#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suffuse/analysis/flow_record.h"

namespace suffuse::analysis {

/// What the contacts of an upward-flow run's layers are like (thesis section 6.5), from its dumps.
struct LayerOptions {
  std::vector<std::string> files;       ///< dumps of grains and contacts
  std::string measures, distributions;  ///< CSV files to write
  double friction = 0.3;
  std::vector<double> bounds;  ///< LOW HIGH of the layers, m; 0 and the column layers_height_m if empty
};

/// Measures all snapshots against the gradients and stresses of the monitor file at the same step (column
/// dem_step), writes the files, and returns a table of the layers at rest and at the last snapshot before the
/// bed moves (`onset_step`), or the last of all. Throws UserError where dumps and record do not belong
/// together.
std::string layer_measures(const LayerOptions& options, const NumberTable& table, const FlowRecord& record,
                           std::optional<double> onset_step);

}  // namespace suffuse::analysis
