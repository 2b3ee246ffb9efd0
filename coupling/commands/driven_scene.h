#pragma once

#include <optional>
#include <string>

#include "../liggghts/liggghts_port.h"
#include "lbm_request.h"
#include "suffuse/coupling/accuracy_choice.h"

namespace suffuse::coupling {

/// What drives the water and the grains, by the script so far, for the errors of accuracy_choice.h.
struct DrivenScene {
  AccuracyScene scene;
  std::string velocity_from;  ///< in words
};

/// `largest_velocity` (m/s) where the script has given one; `region`: the block that the water fills, or
/// empty. Collective.
DrivenScene driven_scene(LAMMPS_NS::LAMMPS* lmp, const LiggghtsPort& port, const LbmRequest& settings,
                         std::optional<double> largest_velocity, const std::string& region);

}  // namespace suffuse::coupling
