#pragma once

#include "liggghts_port.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// What a run of a script acts on: LIGGGHTS, its grains, and these with the water.
struct Scene {
  LAMMPS_NS::LAMMPS* lmp;
  LiggghtsPort& port;
  CoupledSimulation& simulation;
};

}  // namespace suffuse::coupling
