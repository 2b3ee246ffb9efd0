#pragma once

#include <optional>
#include <string>

#include "../liggghts/liggghts_port.h"
#include "lbm_words.h"

namespace suffuse::coupling {

/// Takes the place of `lbm lattice`: chooses spacing, time step, precision and collision operator
/// (accuracy_choice.h) for the grains as they are and what drives the water so far, sets them, and prints
/// what was chosen, why, what is cheaper and dearer, and the `lbm lattice` line that says the same.
/// Collective.
void set_accuracy(LAMMPS_NS::LAMMPS* lmp, const AccuracyRequest& request, const LiggghtsPort& port,
                  LbmRequest& settings);

}  // namespace suffuse::coupling
