#pragma once

#include "../liggghts/liggghts_port.h"
#include "driven_scene.h"
#include "run_price.h"

namespace suffuse::coupling {

/// `lbm plan TIME`: what a run of so many seconds would cost and err by, from its price. `driven`: what
/// drives water and grains, for the table of expected errors by source. Collective.
void print_plan(LAMMPS_NS::LAMMPS* lmp, const RunPrice& price, const LiggghtsPort& port,
                const DrivenScene& driven, double time);

}  // namespace suffuse::coupling
