#include "compute_slipping_index.h"

#include "lammps.h"
#include "suffuse/micromechanics/slipping.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

namespace {
constexpr std::size_t kContactColumns = 8;
}

ComputeSlippingIndex::ComputeSlippingIndex(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  if (!reader.done()) reader.unknown(reader.word("keyword"), "(none)");
  need_friction();
  local_flag = 1;
  size_local_cols = static_cast<int>(kContactColumns);
}

void ComputeSlippingIndex::compute_local() {
  invoked_local = update->ntimestep;
  columns_.clear();
  const Packing& packing = this->packing();
  for (const Contact& contact : packing.contacts) {
    if (!is_counted(packing, contact)) continue;
    const double row[kContactColumns] = {slipping_index(contact),
                                         mobilised_friction(contact),
                                         normal_force(contact),
                                         tangential_force(contact),
                                         static_cast<double>(first_grain(packing, contact).id),
                                         static_cast<double>(second_id(packing, contact)),
                                         contact.friction_limit,
                                         contact.spring_force};
    columns_.insert(columns_.end(), row, row + kContactColumns);
  }
  contact_rows_.clear();
  for (std::size_t row = 0; row < columns_.size(); row += kContactColumns)
    contact_rows_.push_back(&columns_[row]);
  size_local_rows = static_cast<int>(contact_rows_.size());
  array_local = contact_rows_.data();
}
