#include "restart_instant.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "integrate.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

namespace suffuse::coupling {

namespace {

/// The beginning of Verlet::setup, up to its sorting. Neighbour lists and LIGGGHTS's map of grains are not
/// valid after it.
void put_in_place(LAMMPS_NS::LAMMPS* lmp) {
  lmp->modify->setup_pre_exchange();
  lmp->domain->pbc();
  lmp->domain->reset_box();
  lmp->comm->setup();
  if (lmp->neighbor->style != 0) lmp->neighbor->setup_bins();
  lmp->comm->exchange();
}

}  // namespace

void put_grains_in_order(LAMMPS_NS::LAMMPS* lmp) {
  lmp->init();
  put_in_place(lmp);
  lmp->comm->borders();
  lmp->modify->forceMeshExchange();
}

void set_up_again(LAMMPS_NS::LAMMPS* lmp) {
  put_in_place(lmp);
  lmp->atom->setup();
  if (lmp->atom->sortfreq > 0) lmp->atom->sort();
  lmp->modify->addstep_compute_all(lmp->update->ntimestep);
  lmp->update->integrate->setup_minimal(1);
}

}  // namespace suffuse::coupling
