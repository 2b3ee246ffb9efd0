// PairGranVector's passes over the contacts: forces, samples, and LIGGGHTS's own loop beside ours.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "grains/grain_motion.h"
#include "neigh_list.h"
#include "pair_gran_vector.h"
#include "styles/style_support.h"
#include "update.h"

namespace LAMMPS_NS {

using suffuse::grains::ContactNote;
using suffuse::grains::PassSettings;
using suffuse::grains::TangentialLaw;

void PairGranVector::take_motion() {
  const auto owned = static_cast<std::size_t>(atom->nlocal);
  const std::size_t all = owned + static_cast<std::size_t>(atom->nghost);
  position_.resize(all);
  velocity_.resize(all);
  spin_.resize(all);
  if (owned == 0) return;
  const double *x = atom->x[0], *v = atom->v[0], *w = atom->omega[0], *radius = atom->radius,
               *mass = atom->rmass;
  suffuse::grains::gather_motion(
      instruction_set_, {atom->x[0], atom->v[0], atom->omega[0], atom->f[0], atom->torque[0], mass, radius},
      immovable_.data(), owned, position_.data(), velocity_.data(), spin_.data());
  for (const std::size_t i : images_) position_[i] = {x[3 * i], x[3 * i + 1], x[3 * i + 2], radius[i]};
  for (const std::size_t i : foreign_) {
    velocity_[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2], immovable_[i] / mass[i]};
    spin_[i] = {w[3 * i], w[3 * i + 1], w[3 * i + 2], radius[i]};
  }
  if (law_.materials == 1) return;
  material_.resize(all);
  for (std::size_t i = 0; i < all; ++i) material_[i] = atom->type[i] - 1;
}

PassSettings PairGranVector::pass_settings(bool advance) const {
  PassSettings settings;
  settings.law = law_;
  settings.time_step = update->dt;
  settings.advance_springs = advance;
  settings.half_step_normal = half_step_normal_ && update->setupflag == 0;
  settings.drop_lost_springs = drop_lost_springs_;
  settings.pass_number = pass_number_ + 1;
  return settings;
}

void PairGranVector::force_pass(int vflag) {
  take_motion();
  const auto owned = static_cast<std::size_t>(atom->nlocal);
  loads_[owned] = {};  // of the pairs' second grains that other ranks see to
  suffuse::grains::PassOutput wanted;
  wanted.loads = loads_.data();
  wanted.owned = atom->nlocal;
  if (vflag != 0 && vflag_global != 0) wanted.virial = virial;
  if (vflag != 0 && vflag_atom != 0) wanted.grain_virial = vatom[0];
  const bool advance = shearupdate_ != 0;
  suffuse::grains::contact_pass(instruction_set_, active_pairs(),
                                {position_.data(), velocity_.data(), spin_.data(), material_.data()},
                                pass_settings(advance), springs_.data(), wanted);
  if (advance) {
    ++pass_number_;
    springs_are_newer_ = law_.tangential == TangentialLaw::history;
  }
  if (owned == 0) return;
  suffuse::grains::hand_out_loads(instruction_set_, loads_.data(), owned, atom->f[0], atom->torque[0]);
}

/// For `compute pair/gran/local` and our own sampler: every listed pair that touches, in the order of the
/// lists, with the springs as they stand there. Both sides of a pair across a periodic face are one contact
/// here as in the force pass, so that a spring at its Coulomb limit is at the limit on both.
void PairGranVector::sample_pass() {
  springs_to_lists();
  take_motion();
  const bool springy = law_.tangential == TangentialLaw::history;
  const std::size_t total = first_.size();
  std::vector<double*> values(springy ? total : 0, nullptr);
  std::size_t k = 0;
  for (int ii = 0; springy && ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; ++jj, ++k) values[k] = listgranhistory->firstdouble[i] + 3 * jj;
  }
  std::vector<suffuse::grains::Quad> springs;
  for (const std::uint32_t pair : active_pair_)
    if (springy) springs.push_back({values[pair][0], values[pair][1], values[pair][2], pass_number_});

  std::vector<ContactNote> notes;
  suffuse::grains::PassOutput wanted;
  wanted.listener = &notes;
  wanted.note = [](void* to, const ContactNote& note) {
    static_cast<std::vector<ContactNote>*>(to)->push_back(note);
  };
  suffuse::grains::contact_pass(instruction_set_, active_pairs(),
                                {position_.data(), velocity_.data(), spin_.data(), material_.data()},
                                pass_settings(false), springs.data(), wanted);
  tell_contacts(notes, values);
  cpl_pair_finalize();
}

void PairGranVector::tell_contacts(const std::vector<ContactNote>& notes,
                                   const std::vector<double*>& histories) {
  struct Side {
    std::uint32_t pair;
    double sign;
    const double *force, *torque;
  };
  std::vector<Side> sides;
  sides.reserve(notes.size());
  for (const ContactNote& note : notes) {
    const std::uint32_t pair = active_pair_[note.pair];
    sides.push_back({pair, 1, note.force, note.torque});
    if (twin_[pair] != kNoTwin) sides.push_back({twin_[pair], -1, note.force, note.torque_on_second});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.pair < b.pair; });
  for (const Side& side : sides)
    cpl_->add_pair(first_[side.pair], second_[side.pair], side.sign * side.force[0],
                   side.sign * side.force[1], side.sign * side.force[2], side.torque[0], side.torque[1],
                   side.torque[2], histories.empty() ? nullptr : histories[side.pair], nullptr);
}

suffuse::grains::CandidatePairs PairGranVector::active_pairs() const {
  return {active_first_.size(), active_first_.data(), active_second_.data(), active_motion_.data(),
          active_receiver_.data()};
}

/// LIGGGHTS's loop and ours from the same state; what goes on is ours.
void PairGranVector::compare_with_stock(int eflag, int vflag) {
  const auto values = 3 * static_cast<std::size_t>(atom->nlocal);
  double* f = values > 0 ? atom->f[0] : nullptr;
  double* t = values > 0 ? atom->torque[0] : nullptr;
  const std::vector<double> before(f, f + values), torque_before(t, t + values);
  springs_to_lists();
  PairGranProxy::compute_force(eflag, vflag, 0);
  const std::vector<double> stock(f, f + values);
  std::copy(before.begin(), before.end(), f);
  std::copy(torque_before.begin(), torque_before.end(), t);
  if (eflag != 0 || vflag != 0)
    ev_setup(eflag, vflag);
  else
    evflag = vflag_fdotr = 0;
  force_pass(vflag);

  double squares = 0, largest = 0;
  for (std::size_t k = 0; k < values; ++k) {
    squares += (stock[k] - before[k]) * (stock[k] - before[k]);
    largest = std::max(largest, std::abs(f[k] - stock[k]));
  }
  double sums[2] = {squares, static_cast<double>(values)};
  suffuse::sum_over_ranks(lmp, sums);
  double largest_of_all = 0;
  MPI_Allreduce(&largest, &largest_of_all, 1, MPI_DOUBLE, MPI_MAX, world);
  suffuse::tell(
      lmp, fmt::format("pair gran: step {}, largest difference of a force from LIGGGHTS's own loop {:.2g} of "
                       "their rms\n",
                       update->ntimestep, sums[0] > 0 ? largest_of_all / std::sqrt(sums[0] / sums[1]) : 0));
}

}  // namespace LAMMPS_NS
