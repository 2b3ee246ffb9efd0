#include "instance.h"

#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "suffuse/common/error.h"
#include "update.h"

namespace suffuse::coupling {

MPI_Comm communicator_of(LAMMPS_NS::LAMMPS* lmp) {
  return lmp->world;
}

bool is_first_rank(LAMMPS_NS::LAMMPS* lmp) {
  return lmp->comm->me == 0;
}

std::int64_t step_of(LAMMPS_NS::LAMMPS* lmp) {
  return lmp->update->ntimestep;
}

bool is_periodic(LAMMPS_NS::LAMMPS* lmp, int axis) {
  return lmp->domain->periodicity[axis] != 0;
}

void require_box(LAMMPS_NS::LAMMPS* lmp, const std::string& who) {
  if (std::string(lmp->update->unit_style) != "si")
    throw_user_error(
        {who, "units", lmp->update->unit_style, "be si", "write `units si` at the script's head"});
  if (lmp->domain->box_exist == 0)
    throw_user_error({who, "simulation box", "none", "exist", "write `create_box` or `read_restart` before"});
}

void refuse_double_buoyancy(LAMMPS_NS::LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::string(lmp->modify->fix[i]->style).starts_with("buoyancy"))
      throw_user_error(
          {"lbm run", "fix", lmp->modify->fix[i]->id,
           "not act beside `lbm force gravity`: both give grains the weight of the displaced fluid",
           "unfix it, or write `lbm effect buoyancy off`"});
}

void forget_values(LAMMPS_NS::LAMMPS* lmp) {
  lmp->modify->clearstep_compute();
}

}  // namespace suffuse::coupling
