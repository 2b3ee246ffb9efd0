#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

/// Within a run, right before a restart file is written: makes of LIGGGHTS's state the one in which a run
/// begins that reads this file on the same ranks. Grains go to their ranks, into the box and into the order
/// of the file; neighbour lists and forces are those of a set-up, whose damping is that of the velocities at
/// full steps. So both go on alike, to the last digit; a run that saves nothing there differs by round-off
/// and by the damping of half a step. Costs a neighbour list and a step. Collective.
void set_up_again(LAMMPS_NS::LAMMPS* lmp);

/// Between two runs, right before a restart file is written, what LIGGGHTS's `write_restart` does: grains go
/// to their ranks and into the box, so that the next run of either side begins with them in the same order.
/// Collective.
void put_grains_in_order(LAMMPS_NS::LAMMPS* lmp);

}  // namespace suffuse::coupling
