#include "contact_compute.h"

#include "fix_contact_sampler.h"
#include "lammps.h"

using namespace LAMMPS_NS;

ContactCompute::ContactCompute(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : Compute(lmp_in, iarg, narg, arg) {
  timeflag = 1;
  update_on_run_end_ = true;  // so that scripts can use the values after a run, in print or if
  FixContactSampler::of(lmp).add_user(this);
}

ContactCompute::~ContactCompute() {
  FixContactSampler::forget_user(lmp, this);
}

void ContactCompute::init() {
  // Group `all` may be filled later, by insertion; any other group without grains is a slip of the pen.
  if (igroup != 0) suffuse::require_grains_in_group(lmp, who(), igroup);
}

const suffuse::micromechanics::Packing& ContactCompute::packing() {
  return FixContactSampler::of(lmp).packing(groupbit);
}

void ContactCompute::declare_vector(int length) {
  values_.assign(static_cast<std::size_t>(length), 0.0);
  scalar_flag = 1;
  extscalar = 0;
  vector_flag = 1;
  extvector = 0;
  size_vector = length;
  vector = values_.data();
}

void ContactCompute::declare_array(int row_count, int column_count) {
  const auto columns = static_cast<std::size_t>(column_count);
  cells_.assign(static_cast<std::size_t>(row_count) * columns, 0.0);
  rows_.clear();
  for (std::size_t cell = 0; cell < cells_.size(); cell += columns) rows_.push_back(&cells_[cell]);
  array_flag = 1;
  extarray = 0;
  size_array_rows = row_count;
  size_array_cols = column_count;
  array = rows_.data();
}

suffuse::micromechanics::SizeSplit LAMMPS_NS::read_split(suffuse::ArgumentReader& reader) {
  return {reader.positive("split")};
}
