#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse {

/// Whose neighbour lists and contact loop `pair_style gran` gets.
enum class GrainLoop {
  vector,  ///< ours: PairGranVector and NeighborBySize
  stock    ///< LIGGGHTS's, bit for bit
};

/// Adds our fixes, computes and commands to a LIGGGHTS instance, and puts our `run` in place of LIGGGHTS's
/// (it runs LIGGGHTS's own and lets a fix end it early). Call once, before any script line; the script's
/// `clear` does it again.
void register_styles(LAMMPS_NS::LAMMPS* lmp, GrainLoop loop = GrainLoop::vector);

/// The command `run`, able to end early: see early_stop.h. A real interrupt still ends the script.
void run_until_stopped(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

/// Makes a command known that is defined elsewhere. It gets the words after its name.
void add_command(LAMMPS_NS::LAMMPS* lmp, const std::string& name,
                 void (*command)(LAMMPS_NS::LAMMPS*, int narg, char** arg));

/// Names of what register_styles adds, as "fix stress/servo", sorted.
std::vector<std::string> registered_styles();

}  // namespace suffuse
