#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

/// LIGGGHTS's restart file under this name, whole and on the disk when this returns, with all grains inside
/// of a periodic box. A UserError that `who` begins where the disk or memory do not take it. Collective.
void write_grains_file(LAMMPS_NS::LAMMPS* lmp, const std::string& path, const std::string& who);

}  // namespace suffuse::coupling
