#include "compute_coordination.h"

#include "atom.h"
#include "fix_contact_sampler.h"
#include "lammps.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

ComputeCoordination::ComputeCoordination(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "split")
      split_ = read_split(reader);
    else if (key == "walls" || !read_sample_word(key, reader))
      reader.unknown(key, "split, region, bed");
  }
  declare_vector(17);
  peratom_flag = 1;
  size_peratom_cols = 0;
}

void ComputeCoordination::compute_vector() {
  invoked_vector = update->ntimestep;
  const Packing& sample = packing();
  sample_.tell_if_not_the_bed(sample, {true, true, true});
  const CoordinationSums sums = over_ranks(coordination_sums(sample, split_));
  const Coordination z = coordination(sums, sample.volume);
  values_ = {
      z.mean,        z.mechanical,       z.geometric,      z.volume_weighted, z.coarse_coarse,
      z.fine_coarse, z.fine_fine,        z.fines_mean,     z.stable_share,    z.unconnected_fines_share,
      sums.contacts, sums.coarse_coarse, sums.fine_coarse, sums.fine_fine,    sums.grains,
      sums.fines,    sums.unconnected};
  vector = values_.data();
}

void ComputeCoordination::compute_peratom() {
  invoked_peratom = update->ntimestep;
  const std::vector<int> contacts = contacts_per_grain(packing_of_group());
  const std::vector<int>& index = FixContactSampler::of(lmp).grain_index(groupbit);
  contacts_of_atom_.assign(static_cast<std::size_t>(atom->nmax), 0.0);
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] != kNotOwned) contacts_of_atom_[i] = contacts[static_cast<std::size_t>(index[i])];
  vector_atom = contacts_of_atom_.data();
}
