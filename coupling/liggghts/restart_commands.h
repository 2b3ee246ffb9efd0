#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

/// LIGGGHTS's `read_restart` and `write_restart` with a look at the file: before it is read (LIGGGHTS waits
/// for ever for what a truncated one lacks), and after it was written (LIGGGHTS does not see that a disk is
/// full); and `restart_set` and `run` (saving_verlet.h).
void add_restart_commands(LAMMPS_NS::LAMMPS* lmp);

/// A UserError where sets of grains alone are being saved: with water they would be half a state.
void require_no_sets_of_grains(LAMMPS_NS::LAMMPS* lmp, const std::string& who);

}  // namespace suffuse::coupling
