#include "neighbor_by_size.h"

#include <algorithm>

#include "atom.h"
#include "error.h"
#include "fix_contact_history.h"
#include "neigh_list.h"
#include "neigh_request.h"

namespace LAMMPS_NS {

namespace {
constexpr int kBin = 1, kMulti = 2;  // Neighbor::style
}

void NeighborBySize::init() {
  if (style == kMulti) style = kBin;
  Neighbor::init();
}

void NeighborBySize::build(int topoflag) {
  ++generation_;
  Neighbor::build(topoflag);
}

void NeighborBySize::choose_build(int index, NeighRequest* request) {
  Neighbor::choose_build(index, request);
  // Half lists without Newton's third law across ranks, which history needs; copies, skips and others stay.
  if (pair_build[index] == &NeighborBySize::granular_bin_no_newton && includegroup == 0)
    pair_build[index] = static_cast<PairPtr>(&NeighborBySize::granular_by_size);
}

void NeighborBySize::granular_by_size(NeighList* list) {
  const int owned = atom->nlocal;
  double sum = 0;
  for (int n = 0; n < 3 * (owned + atom->nghost); ++n) sum += 0 * atom->x[0][n];
  if (!(sum == 0))
    error->one(FLERR,
               "Position of a grain is not a number: the simulation is unstable; take a smaller time step, "
               "or see what forces the script adds");
  bin_atoms();  // walls of triangles and others read these bins
  if (owned == 0) {
    list->inum = 0;
    return;
  }
  pairs_.find({atom->x[0], atom->radius, owned, owned + atom->nghost}, contactDistanceFactor, skin);

  NeighList* history = list->fix_history != nullptr ? list->listgranhistory : nullptr;
  list->ipage->reset();
  if (history != nullptr) {
    history->ipage->reset();
    history->dpage->reset();
  }
  for (int i = 0; i < owned; ++i) {
    if (pairs_.count(i) > oneatom) error->one(FLERR, "Neighbor list overflow, boost neigh_modify one");
    int* partners = list->ipage->vget();
    int* flags = history != nullptr ? history->ipage->vget() : nullptr;
    double* histories = history != nullptr ? history->dpage->vget() : nullptr;
    const int count = list_partners(list, i, partners, flags, histories);
    list->ilist[i] = i;
    list->firstneigh[i] = partners;
    list->numneigh[i] = count;
    list->ipage->vgot(count);
    if (history == nullptr) continue;
    history->firstneigh[i] = flags;
    history->firstdouble[i] = histories;
    history->ipage->vgot(count);
    history->dpage->vgot(count * history->dnum);
  }
  list->inum = owned;
}

int NeighborBySize::list_partners(NeighList* list, int grain, int* partners, int* flags,
                                  double* histories) const {
  FixContactHistory* known = list->fix_history;
  const int values = known != nullptr ? list->listgranhistory->dnum : 0;
  const int touching = known != nullptr ? known->n_partner(grain) : 0;
  const double* x = atom->x[grain];
  const int* found = pairs_.partners(grain);
  int count = 0;
  for (int k = 0; k < pairs_.count(grain); ++k) {
    const int j = found[k];
    if (exclude != 0 &&
        exclusion(grain, j, atom->type[grain], atom->type[j], atom->mask, atom->molecule) != 0)
      continue;
    partners[count] = j;
    if (known != nullptr) {
      flags[count] = 0;
      std::fill_n(histories + count * values, values, 0.);
      const double* y = atom->x[j];
      const double reach = (atom->radius[grain] + atom->radius[j]) * contactDistanceFactor;
      const double dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
      if (touching > 0 && dx * dx + dy * dy + dz * dz < reach * reach) {
        for (int m = 0; m < touching; ++m) {
          if (known->partner(grain, m) != atom->tag[j]) continue;
          flags[count] = 1;
          std::copy_n(known->contacthistory(grain, m), values, histories + count * values);
          break;
        }
      }
    }
    ++count;
  }
  return count;
}

}  // namespace LAMMPS_NS
