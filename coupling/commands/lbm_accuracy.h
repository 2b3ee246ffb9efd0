#pragma once

#include <string>

#include "../liggghts/liggghts_port.h"
#include "lbm_words.h"

namespace suffuse::coupling {

/// Takes the place of `lbm method` and `lbm lattice`, for a request that has an accuracy: chooses the flow,
/// resolved or averaged, spacing, time step, precision and collision operator (accuracy_choice.h) for the
/// grains as they are and what drives the water so far, sets them, and prints what was chosen, why, what is
/// cheaper and dearer with errors and prices (trial_costs.h), and the lines that say the same. Collective.
void set_accuracy(LAMMPS_NS::LAMMPS* lmp, const AccuracyRequest& request, LiggghtsPort& port,
                  LbmRequest& settings);

/// Cells and steps as variables of the script, in a file to be included: lattice_spacing (m),
/// lattice_timestep (s), lattice_sound (m/s), the speed of pressure in the water; the averaged flow, whose
/// density is constant, counts as 1e9 m/s. Collective.
void write_lattice(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, const std::string& file);

}  // namespace suffuse::coupling
