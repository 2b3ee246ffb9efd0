#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suffuse/micromechanics/layer_contacts.h"
#include "verdict/flow_record.h"

namespace suffuse::analysis {

/// What the contacts of an upward-flow run's layers are like (thesis section 6.5), from its dumps.
struct LayerOptions {
  std::vector<std::string> files;       ///< dumps of grains and contacts
  std::string measures, distributions;  ///< CSV files to write
  double friction = 0.3;
  /// LOW HIGH of the layers, m; the columns layers_floor_m (0 without it) and layers_top_m (layers_height_m
  /// without it) if empty.
  std::vector<double> bounds;
};

/// One layer (or all of them) in one snapshot.
struct LayerMeasures {
  micromechanics::LayerNetwork network;
  micromechanics::BrokenContacts broken;
  double gradient = 0;                 ///< its own; of all: the bed's
  std::optional<double> stress_ratio;  ///< σ'/σ'₀
  int median_coordination = 0;
  double coordination_d50 = 0, coordination_d85 = 0;  ///< mean contacts of grains of d50, d85 and larger
};

struct SnapshotMeasures {
  double step = 0, time = 0;
  std::vector<LayerMeasures> layers;  ///< from the top; the last is of all
};

/// What the dumps say, with the table of it for the terminal.
struct LayerResults {
  std::string text;
  SnapshotMeasures at_rest;                  ///< the first snapshot
  std::optional<SnapshotMeasures> at_onset;  ///< the last one before the bed moves; none if it does not
};

/// Measures all snapshots against the gradients and stresses of the monitor file at the same step (column
/// dem_step), writes the files, and returns the layers at rest and at the last snapshot before the bed moves
/// (`onset_step`). Throws UserError where dumps and record do not belong together.
LayerResults layer_measures(const LayerOptions& options, const NumberTable& table, const FlowRecord& record,
                            std::optional<double> onset_step);

}  // namespace suffuse::analysis
