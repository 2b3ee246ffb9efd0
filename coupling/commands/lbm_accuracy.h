#pragma once

#include <optional>
#include <string>

#include "../liggghts/liggghts_port.h"
#include "lbm_settings.h"

namespace suffuse::coupling {

/// `lbm accuracy 3% [max_velocity U] [region ID]`
struct AccuracyRequest {
  double accuracy = 0.03;                  ///< a share
  std::optional<double> largest_velocity;  ///< m/s; else from what drives water and grains
  std::string region;
};

/// A UserError for words that it does not know and values that cannot work.
AccuracyRequest read_accuracy(ArgumentReader& reader);

/// Takes the place of `lbm lattice`: chooses spacing, time step, precision and collision operator
/// (accuracy_choice.h) for the grains as they are and what drives the water so far, sets them, and prints
/// what was chosen, why, what is cheaper and dearer, and the `lbm lattice` line that says the same.
/// Collective.
void set_accuracy(LAMMPS_NS::LAMMPS* lmp, const AccuracyRequest& request, const LiggghtsPort& port,
                  LbmSettings& settings);

}  // namespace suffuse::coupling
