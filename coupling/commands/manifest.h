#pragma once

#include <string>
#include <vector>

#include "../liggghts/liggghts_port.h"
#include "lbm_request.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/coupling/effects.h"

namespace suffuse::coupling {

/// What a run is going to do, before it starts: lattice, solids, grains, effects with their reasons, and what
/// may cost accuracy. One line each; those about walls are given.
std::vector<std::string> manifest(const CoupledSimulation& simulation, const LiggghtsPort::Summary& grains,
                                  const std::vector<EffectState>& effects,
                                  const std::vector<std::string>& walls);

/// "3.81 to 6.83 cells per diameter, Sauter mean 4.97". Needs at least one grain.
/// Says so where the smallest grains are too coarse for their drag; empty otherwise.
std::string resolution_note(const LiggghtsPort::Summary& grains, double spacing);

std::string sizes_text(const LiggghtsPort::Summary& grains, double spacing);

/// Where the time went, as a table: each part in seconds, milliseconds a step and share, the slowest rank's.
/// `steps` of the fluid, of which `rested` had no lattice, `grain_steps` steps of single grains, `wall`
/// seconds in all. Collective.
std::string time_table(CoupledSimulation& simulation, long steps, long rested, double grain_steps,
                       double wall);

}  // namespace suffuse::coupling
