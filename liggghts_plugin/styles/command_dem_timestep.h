#ifdef COMMAND_CLASS

// clang-format off
CommandStyle(dem_timestep, CommandDemTimestep)
// clang-format on

#else

#ifndef SUFFUSE_COMMAND_DEM_TIMESTEP_H
#define SUFFUSE_COMMAND_DEM_TIMESTEP_H

#include "pointers.h"

namespace LAMMPS_NS {

/// dem_timestep rayleigh SHARE | check  pressure P
///
/// Sets the time step as a share of the smallest grain's Rayleigh time, or checks the one in force, and
/// prints where it stands against the limits of thesis eqs 3.3–3.4 and how soft the contacts are. Page:
/// docs/reference/dem_timestep.md.
class CommandDemTimestep : protected Pointers {
 public:
  explicit CommandDemTimestep(LAMMPS* lmp_in) : Pointers(lmp_in) {}
  void command(int narg, char** arg);
};

}  // namespace LAMMPS_NS

#endif
#endif
