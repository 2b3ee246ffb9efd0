#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

// What commands ask of a LIGGGHTS instance besides its grains, so that none of them needs its headers.

MPI_Comm communicator_of(LAMMPS_NS::LAMMPS* lmp);
bool is_first_rank(LAMMPS_NS::LAMMPS* lmp);
/// The number of the step that has been made last.
std::int64_t step_of(LAMMPS_NS::LAMMPS* lmp);
/// Is its box periodic across this axis?
bool is_periodic(LAMMPS_NS::LAMMPS* lmp, int axis);

/// A UserError unless the script has SI units and a box.
void require_box(LAMMPS_NS::LAMMPS* lmp, const std::string& who);

/// A UserError where a fix of the script gives grains the weight of the displaced fluid as well.
void refuse_double_buoyancy(LAMMPS_NS::LAMMPS* lmp);

/// Values of computes of other steps are not those of this one: those that are asked for from now on are
/// found anew where their steps differ.
void forget_values(LAMMPS_NS::LAMMPS* lmp);

}  // namespace suffuse::coupling
