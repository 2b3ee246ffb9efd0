#pragma once

#include "../liggghts/liggghts_port.h"
#include "lbm_words.h"

namespace suffuse::coupling {

/// Takes the place of `lbm method` and `lbm lattice`: chooses the flow, resolved or averaged, spacing, time
/// step, precision and collision operator (accuracy_choice.h) for the grains as they are and what drives the
/// water so far, sets them, and prints what was chosen, why, what is cheaper and dearer with errors and
/// prices (trial_costs.h), and the lines that say the same. Collective.
void set_accuracy(LAMMPS_NS::LAMMPS* lmp, const AccuracyRequest& request, LiggghtsPort& port,
                  LbmRequest& settings);

}  // namespace suffuse::coupling
