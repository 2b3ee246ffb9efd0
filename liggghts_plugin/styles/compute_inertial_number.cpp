#include "compute_inertial_number.h"

#include <algorithm>
#include <cmath>

#include "comm.h"
#include "domain.h"
#include "lammps.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/inertial_number.h"
#include "suffuse/micromechanics/stress.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

ComputeInertialNumber::ComputeInertialNumber(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "diameter") {
      if (reader.next_is_number())
        given_diameter_ = reader.positive("diameter");
      else if (const std::string which = reader.word("diameter (mass, number, d50 or a value in m)");
               which == "mass")
        kind_ = MeanDiameter::mass;
      else if (which == "number")
        kind_ = MeanDiameter::number;
      else if (which == "d50")
        kind_ = MeanDiameter::d50;
      else
        suffuse::throw_user_error({who(), "diameter", which, "be mass, number, d50 or a value in m", ""});
    } else if (key == "rate") {
      rate_given_ = !reader.accept("measured");
      if (rate_given_) rate_ = reader.number("rate");
    } else if (!read_sample_word(key, reader)) {
      reader.unknown(key, std::string("diameter, rate, ") + suffuse::SampleChoice::kWords);
    }
  }
  sample_is_read();
  declare_vector(5);
}

void ComputeInertialNumber::init() {
  ContactCompute::init();
  // Between runs a script may have numbered the steps anew or changed their length.
  const bool goes_on = run_end_ == update->ntimestep && lengths_step_ <= run_end_;
  if (lengths_step_ < 0 || !goes_on || dt_ != update->dt) remember_box();
  if (update->whichflag != 0) run_end_ = update->laststep;  // not where a command sets up
}

void ComputeInertialNumber::remember_box() {
  lengths_ = {domain->xprd, domain->yprd, domain->zprd};
  lengths_step_ = update->ntimestep;
  dt_ = update->dt;
}

void ComputeInertialNumber::measure_rate() {
  const double time = static_cast<double>(update->ntimestep - lengths_step_) * update->dt;
  if (time <= 0) return;  // asked twice in one step: the rate stays
  const std::array<double, 3> now{domain->xprd, domain->yprd, domain->zprd};
  rate_ = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    rate_ = std::max(rate_, std::abs(std::log(now[axis] / lengths_[axis])) / time);
  remember_box();
}

double ComputeInertialNumber::median_diameter_by_mass() {
  std::vector<double> mine;
  for (const Grain& grain : packing().grains) mine.push_back(2 * grain.radius);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(comm->nprocs)), offsets(counts.size(), 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (std::size_t rank = 1; rank < counts.size(); ++rank)
    offsets[rank] = offsets[rank - 1] + counts[rank - 1];
  std::vector<double> all(static_cast<std::size_t>(offsets.back() + counts.back()));
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE,
                 world);
  return diameter_finer_than(all, 0.5);
}

void ComputeInertialNumber::compute_vector() {
  invoked_vector = update->ntimestep;
  const Packing& sample = packing();
  sample_.tell_if_not_the_bed(sample, {true, true, true});
  if (!rate_given_) measure_rate();
  InertialState state;
  state.strain_rate = rate_;
  state.density = suffuse::grain_statistics(lmp, groupbit).mean_density;
  state.pressure = mean_stress(over_ranks(stress_times_volume(sample)).matrix()) / sample.volume;
  if (given_diameter_ > 0)
    state.diameter = given_diameter_;
  else if (kind_ == MeanDiameter::d50)
    state.diameter = median_diameter_by_mass();
  else
    state.diameter = mean_diameter(over_ranks(diameter_sums(sample)), kind_);
  values_ = {inertial_number(state), state.strain_rate, state.diameter, state.pressure, state.density};
  vector = values_.data();
}
