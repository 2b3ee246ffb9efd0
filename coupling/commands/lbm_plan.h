#pragma once

#include "../liggghts/liggghts_port.h"
#include "lbm_accuracy.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// `lbm plan TIME`: what a run would cost. Times a few steps of a fluid of the same size and settings and a
/// mapping of the grains as they are, and throws both away; grains are counted at the speed of this process's
/// last run, or at that of a usual core. `looks`: how often a step monitors and guards look at all cells.
/// `driven`: what drives water and grains, for the table of expected errors by source.
/// Times are those on processors of one's own: without what other programs took from the trial. Nothing of
/// the script's state changes. Collective.
void plan_run(LAMMPS_NS::LAMMPS* lmp, const CoupledSettings& settings, const lbm::Decomposition& parts,
              const Vec3& low, LiggghtsPort& port, const DrivenScene& driven, double time, double looks);

}  // namespace suffuse::coupling
