#include "fix_contact_history_vector.h"

#include "pair_gran_vector.h"

namespace LAMMPS_NS {

void FixContactHistoryVector::pre_exchange() {
  if (auto* pair = dynamic_cast<PairGranVector*>(pair_gran_)) pair->springs_to_lists();
  FixContactHistory::pre_exchange();
}

}  // namespace LAMMPS_NS
