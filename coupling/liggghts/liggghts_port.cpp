#include "liggghts_port.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "force_fix.h"
#include "lammps.h"
#include "modify.h"
#include "restart_instant.h"
#include "styles/fix_hydrodynamic_force.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"
#include "update.h"

namespace suffuse::coupling {

using LAMMPS_NS::FixHydrodynamicForce;
using LAMMPS_NS::LAMMPS;

LiggghtsPort::LiggghtsPort(LAMMPS* lmp) : GrainQuestions(lmp), RunControl(lmp), lmp_(lmp) {
  if (lmp->atom->superquadric_flag != 0)
    throw_user_error({"lbm run", "atom_style", "superquadric", "be spheres", "write `atom_style granular`"});
  require_single_spheres(lmp, "lbm run");
  if (find_force_fix(lmp) == nullptr) {
    std::string id = "hydrodynamic_force", group = "all", style = "hydrodynamic/force";
    char* words[] = {id.data(), group.data(), style.data()};
    lmp->modify->add_fix(3, words);
    made_fix_ = true;
  }
  fix_ = &force_fix(lmp);
}

void LiggghtsPort::withdraw() {
  if (made_fix_ && find_force_fix(lmp_) != nullptr) lmp_->modify->delete_fix(find_force_fix(lmp_)->id);
  made_fix_ = false;
}

void LiggghtsPort::refresh() {
  fix_ = &force_fix(lmp_);
  keep_memory();
  // Before anything has been run there are no ghosts, nor LIGGGHTS's lists of whom to tell.
  if (lmp_->update->first_update != 0) fix_->update_ghost_velocities();
  arrays_ = {};
  all_grains_ = fix_->igroup == 0;
  if (all_grains_)
    view_all();
  else
    copy_group();
}

void LiggghtsPort::view_all() {
  const auto* atom = lmp_->atom;
  arrays_.owned = atom->nlocal;
  arrays_.total = atom->nlocal + atom->nghost;
  if (arrays_.total == 0) return;
  arrays_.position = atom->x[0];
  arrays_.velocity = atom->v[0];
  arrays_.angular_velocity = atom->omega[0];
  arrays_.radius = atom->radius;
  arrays_.mass = atom->rmass;
  arrays_.id = atom->tag;
}

void LiggghtsPort::copy_group() {
  const auto* atom = lmp_->atom;
  const int all = atom->nlocal + atom->nghost;
  local_.clear();
  for (int i = 0; i < all; ++i) {
    if ((atom->mask[i] & fix_->groupbit) != 0) local_.push_back(i);
    if (i + 1 == atom->nlocal) arrays_.owned = static_cast<int>(local_.size());
  }
  arrays_.total = static_cast<int>(local_.size());
  position_.clear();
  velocity_.clear();
  spin_.clear();
  radius_.clear();
  mass_.clear();
  id_.clear();
  for (const int i : local_) {
    position_.insert(position_.end(), atom->x[i], atom->x[i] + 3);
    velocity_.insert(velocity_.end(), atom->v[i], atom->v[i] + 3);
    spin_.insert(spin_.end(), atom->omega[i], atom->omega[i] + 3);
    radius_.push_back(atom->radius[i]);
    mass_.push_back(atom->rmass[i]);
    id_.push_back(atom->tag[i]);
  }
  arrays_.position = position_.data();
  arrays_.velocity = velocity_.data();
  arrays_.angular_velocity = spin_.data();
  arrays_.radius = radius_.data();
  arrays_.mass = mass_.data();
  arrays_.id = id_.data();
}

void LiggghtsPort::sum_over_copies(std::vector<GrainSums>& sums) {
  static_assert(sizeof(GrainSums) == FixHydrodynamicForce::kSumValues * sizeof(double));
  const auto exchange = [this](std::vector<GrainSums>& all) {
    fix_->sum_over_ghosts(reinterpret_cast<double*>(all.data()));
  };
  if (all_grains_) return exchange(sums);
  std::vector<GrainSums> all(static_cast<std::size_t>(lmp_->atom->nlocal + lmp_->atom->nghost));
  for (std::size_t n = 0; n < local_.size(); ++n) all[static_cast<std::size_t>(local_[n])] = sums[n];
  exchange(all);
  for (std::size_t n = 0; n < local_.size(); ++n) sums[n] = all[static_cast<std::size_t>(local_[n])];
}

GrainMemory LiggghtsPort::memory() {
  if (lmp_->atom->nlocal == 0) return {};
  if (all_grains_) return {fix_->load(), fix_->records()};
  keep_memory();
  records_.clear();
  for (const int i : local_) {
    if (i >= lmp_->atom->nlocal) break;
    const double* load = fix_->load() + FixHydrodynamicForce::kLoadValues * i;
    load_.insert(load_.end(), load, load + FixHydrodynamicForce::kLoadValues);
    records_.push_back(fix_->records()[i]);
  }
  return {load_.data(), records_.data()};
}

double LiggghtsPort::time_step() const {
  return lmp_->update->dt;
}

/// With a part of the grains: writes what was put in memory() back to the fix. Where a grain has moved
/// elsewhere since, a set-up has come between, and nobody had written to its copy.
void LiggghtsPort::keep_memory() {
  for (std::size_t n = 0; n < load_.size() / FixHydrodynamicForce::kLoadValues; ++n) {
    if (local_[n] >= lmp_->atom->nlocal || lmp_->atom->tag[local_[n]] != id_[n]) continue;
    std::copy_n(&load_[FixHydrodynamicForce::kLoadValues * n], FixHydrodynamicForce::kLoadValues,
                fix_->load() + FixHydrodynamicForce::kLoadValues * local_[n]);
    fix_->records()[local_[n]] = records_[n];
  }
  load_.clear();
}

/// Loads that no step will apply are not worth the work.
void LiggghtsPort::advance(int substeps) {
  keep_memory();
  if (reads_loads(substeps)) fix_->loads_changed();
  make_steps(substeps);
  fix_->interval_over();
}

void LiggghtsPort::set_up_again() {
  keep_memory();
  coupling::set_up_again(lmp_);
}

/// Fixes, computes and lists as between two runs, then as a saved state is taken up.
void LiggghtsPort::set_up_with_new_fixes() {
  keep_memory();
  lmp_->init();
  coupling::set_up_again(lmp_);
}

}  // namespace suffuse::coupling
