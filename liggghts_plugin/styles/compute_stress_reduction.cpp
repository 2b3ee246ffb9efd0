#include "compute_stress_reduction.h"

#include "atom.h"
#include "fix_contact_sampler.h"
#include "lammps.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/stress_reduction.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

GrainArm LAMMPS_NS::read_arm(suffuse::ArgumentReader& reader) {
  const std::string given = reader.word("by");
  if (given == "contact_point") return GrainArm::contact_point;
  if (given == "pair_halves") return GrainArm::pair_halves;
  suffuse::throw_user_error({reader.who(), "by", given, "be contact_point or pair_halves",
                             "contact_point is thesis eq 4.2, pair_halves its Appendix F"});
}

ComputeStressReduction::ComputeStressReduction(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "split")
      split_ = read_split(reader);
    else if (key == "by")
      arm_ = read_arm(reader);
    else if (!read_sample_word(key, reader))
      reader.unknown(key, std::string("split, by, ") + suffuse::SampleChoice::kWords);
  }
  sample_is_read();
  if (split_.diameter <= 0)
    suffuse::throw_user_error({who(), "split", "nothing", "be given",
                               "add `split DIAMETER`: grains of a smaller diameter are the fines"});
  declare_vector(8);
  peratom_flag = 1;
  size_peratom_cols = 6;
}

void ComputeStressReduction::compute_vector() {
  invoked_vector = update->ntimestep;
  const Packing& sample = packing();
  sample_.tell_if_not_the_bed(sample, {true, true, true});
  sample_.tell_if_walls_are_left_out();
  const StressReduction result =
      stress_reduction(over_ranks(stress_reduction_sums(sample, split_, arm_)), sample.volume);
  values_ = {result.shire,
             result.sufian,
             result.beta.value_or(0),
             result.fines_stress_share,
             result.beta.has_value() ? 1.0 : 0.0,
             result.fines_solid_share,
             result.mean_stress,
             result.fines_mean_stress};
  vector = values_.data();
}

void ComputeStressReduction::compute_peratom() {
  invoked_peratom = update->ntimestep;
  const std::vector<suffuse::Mat3> stress = grain_stress_times_volume(packing_of_group(), arm_);
  const std::vector<int>& index = FixContactSampler::of(lmp).grain_index(groupbit);
  const auto rows = static_cast<std::size_t>(atom->nmax);
  components_.assign(6 * rows, 0.0);
  component_rows_.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) component_rows_[i] = &components_[6 * i];
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] == kNotOwned) continue;
    const suffuse::Mat3& s = stress[static_cast<std::size_t>(index[i])];
    const double values[6] = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)};
    std::copy(values, values + 6, component_rows_[i]);
  }
  array_atom = component_rows_.data();
}
