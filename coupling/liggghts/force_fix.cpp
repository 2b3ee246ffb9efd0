#include "force_fix.h"

#include "lammps.h"
#include "modify.h"
#include "styles/fix_hydrodynamic_force.h"
#include "suffuse/common/error.h"

namespace suffuse::coupling {

LAMMPS_NS::FixHydrodynamicForce* find_force_fix(LAMMPS_NS::LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (auto* fix = dynamic_cast<LAMMPS_NS::FixHydrodynamicForce*>(lmp->modify->fix[i])) return fix;
  return nullptr;
}

LAMMPS_NS::FixHydrodynamicForce& force_fix(LAMMPS_NS::LAMMPS* lmp) {
  if (auto* fix = find_force_fix(lmp)) return *fix;
  throw_user_error({"lbm run", "fix hydrodynamic/force", "gone",
                    "stay while there is a fluid: it carries the loads",
                    "drop the `unfix`, or end the fluid with `lbm clear` before it"});
}

}  // namespace suffuse::coupling
