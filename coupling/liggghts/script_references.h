#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

/// The values that a reference of a script (`c_ID`, `f_ID`, `v_NAME`, with indices) stands for, each as a
/// reference of its own: one with [*] stands for each row of the compute's or fix's array, or each value of
/// its vector. A UserError if there is no such thing.
std::vector<std::string> expanded_references(LAMMPS_NS::LAMMPS* lmp, const std::string& reference);

/// What a reference gives now, or any formula of an equal-style variable. Collective.
double value_of_reference(LAMMPS_NS::LAMMPS* lmp, const std::string& reference);

/// The bit of a group of the script; 0 if there is none of that name.
int group_bit(LAMMPS_NS::LAMMPS* lmp, const std::string& group);

}  // namespace suffuse::coupling
