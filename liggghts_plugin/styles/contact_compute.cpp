#include "contact_compute.h"

#include "fix_contact_sampler.h"
#include "lammps.h"
#include "update.h"

using namespace LAMMPS_NS;

ContactCompute::ContactCompute(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : Compute(lmp_in, iarg, narg, arg), sample_(lmp_in, who()) {
  suffuse::require_si_and_three_dimensions(lmp, who());
  timeflag = 1;
  update_on_run_end_ = true;  // so that scripts can use the values after a run, in print or if
  FixContactSampler::of(lmp).add_user(this);
}

ContactCompute::~ContactCompute() {
  FixContactSampler::forget_user(lmp, this);
}

void ContactCompute::init() {
  suffuse::require_single_spheres(lmp, who());
  // Group `all` may be filled later, by insertion; any other group without grains is a slip of the pen.
  if (igroup != 0) suffuse::require_grains_in_group(lmp, who(), igroup);
  sample_.init();
}

bool ContactCompute::read_sample_word(const std::string& key, suffuse::ArgumentReader& reader) {
  return sample_.read(key, reader);
}

void ContactCompute::count_walls_by_default() {
  sample_.walls = true;
}

void ContactCompute::sample_is_read() {
  if (sample_.walls) FixContactSampler::of(lmp).add_wall_user(this);
}

const suffuse::micromechanics::Packing& ContactCompute::packing_of_group() {
  FixContactSampler& sampler = FixContactSampler::of(lmp);
  const auto& own = needs_friction_ ? sampler.packing_with_friction(groupbit) : sampler.packing(groupbit);
  if (!sample_.walls) return own;
  const auto walls = sampler.walls(groupbit);  // may sample, and so raise the generation
  if (group_generation_ != sampler.generation()) {
    group_ = own;
    group_.walls = walls;
    group_generation_ = sampler.generation();
  }
  return group_;
}

const suffuse::micromechanics::Packing& ContactCompute::packing() {
  const auto& group_packing = packing_of_group();
  if (sample_.is_whole_box()) return group_packing;
  const std::int64_t generation = FixContactSampler::of(lmp).generation();
  if (part_generation_ != generation) {
    part_ = sample_.part_of(group_packing);
    part_generation_ = generation;
  }
  return part_;
}

void ContactCompute::need_friction() {
  needs_friction_ = true;
  FixContactSampler::of(lmp).add_friction_user(this);
}

double ContactCompute::compute_scalar() {
  compute_vector();
  invoked_scalar = update->ntimestep;
  return scalar = values_[0];
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
