#include "liggghts_port.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

#include "atom.h"
#include "domain.h"
#include "fix.h"
#include "fix_gravity.h"
#include "integrate.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "restart_instant.h"
#include "signal_handling.h"
#include "styles/early_stop.h"
#include "styles/fix_contact_sampler.h"
#include "styles/fix_hydrodynamic_force.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"
#include "timer.h"
#include "update.h"

namespace suffuse::coupling {

using LAMMPS_NS::bigint;
using LAMMPS_NS::FixHydrodynamicForce;
using LAMMPS_NS::LAMMPS;

namespace {

FixHydrodynamicForce* find_force_fix(LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (auto* fix = dynamic_cast<FixHydrodynamicForce*>(lmp->modify->fix[i])) return fix;
  return nullptr;
}

}  // namespace

LiggghtsPort::LiggghtsPort(LAMMPS* lmp) : lmp_(lmp) {
  if (lmp->atom->superquadric_flag != 0)
    throw_user_error({"lbm run", "atom_style", "superquadric", "be spheres", "write `atom_style granular`"});
  require_single_spheres(lmp, "lbm run");
  if (find_force_fix(lmp) == nullptr) {
    std::string id = "hydrodynamic_force", group = "all", style = "hydrodynamic/force";
    char* words[] = {id.data(), group.data(), style.data()};
    lmp->modify->add_fix(3, words);
    made_fix_ = true;
  }
  fix_ = find_force_fix(lmp);
  keep_box();
}

void LiggghtsPort::withdraw() {
  if (made_fix_ && find_force_fix(lmp_) != nullptr) lmp_->modify->delete_fix(find_force_fix(lmp_)->id);
  made_fix_ = false;
}

void LiggghtsPort::refresh() {
  fix_ = find_force_fix(lmp_);
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

bool LiggghtsPort::anything_moves() const {
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (lmp_->modify->fix[i]->time_integrate != 0) return true;
  return false;
}

std::optional<Vec3> LiggghtsPort::gravity_on_grains() const {
  Vec3 sum = Vec3::Zero();
  bool found = false;
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (auto* gravity = dynamic_cast<LAMMPS_NS::FixGravity*>(lmp_->modify->fix[i])) {
      Vec3 own;
      gravity->get_gravity(own.data());
      sum += own;
      found = true;
    }
  return found ? std::optional(sum) : std::nullopt;
}

LiggghtsPort::HeldInMotion LiggghtsPort::held_in_motion() const {
  int moved = 0;
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (lmp_->modify->fix[i]->time_integrate != 0) moved |= lmp_->modify->fix[i]->groupbit;
  const auto* atom = lmp_->atom;
  double grains = 0, speed = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & fix_->groupbit) == 0 || (atom->mask[i] & moved) != 0) continue;
    const double own = Eigen::Map<const Vec3>(atom->v[i]).norm() +
                       atom->radius[i] * Eigen::Map<const Vec3>(atom->omega[i]).norm();
    if (own > 0) grains += 1;
    speed = std::max(speed, own);
  }
  MPI_Allreduce(MPI_IN_PLACE, &grains, 1, MPI_DOUBLE, MPI_SUM, lmp_->world);
  MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, lmp_->world);
  return {static_cast<std::int64_t>(grains), speed};
}

bool LiggghtsPort::loads_restored() const {
  // Grains migrate, and a rank may have had none: restored on one rank is restored on all.
  int mine[2] = {lmp_->atom->nlocal > 0 ? 1 : 0, fix_->restored() ? 1 : 0};
  MPI_Allreduce(MPI_IN_PLACE, mine, 2, MPI_INT, MPI_MAX, lmp_->world);
  return mine[0] == 0 || mine[1] != 0;
}

constexpr std::int64_t kNoStep = std::numeric_limits<std::int64_t>::max();

/// Styles whose work in a step is done anew in the next one, or that have none while grains stay where they
/// are: forces, and what is kept with grains, meshes and lists. Others count, or change something.
constexpr std::string_view kOfTheMoment[] = {"freeze",
                                             "setforce",
                                             "aveforce",
                                             "planeforce",
                                             "lineforce",
                                             "enforce2d",
                                             "gravity",
                                             "addforce",
                                             "buoyancy",
                                             "viscous",
                                             "drag",
                                             "wall/gran",
                                             "property/atom",
                                             "property/global",
                                             "contacthistory",
                                             "contacthistory/mesh",
                                             "neighlist/mesh",
                                             "mesh/surface",
                                             "mesh/surface/planar",
                                             "contact/sampler",
                                             "hydrodynamic/force",
                                             "lubrication",
                                             "store/force"};

/// Is there something that `run` would do in every step, although no fix integrates motion? Held grains that
/// have a velocity all the same load their contacts in every step.
bool LiggghtsPort::acts_in_every_step() const {
  using namespace LAMMPS_NS::FixConst;
  constexpr int in_a_step = INITIAL_INTEGRATE | POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | PRE_FORCE |
                            POST_FORCE | PRE_FINAL_INTEGRATE | FINAL_INTEGRATE | PRE_INITIAL_INTEGRATE;
  for (int i = 0; i < lmp_->modify->nfix; ++i) {
    const std::string_view style = lmp_->modify->fix[i]->style;
    const bool of_the_moment =
        std::find(std::begin(kOfTheMoment), std::end(kOfTheMoment), style) != std::end(kOfTheMoment);
    if ((lmp_->modify->fmask[i] & in_a_step) != 0 && !of_the_moment) return true;
  }
  return held_in_motion().grains > 0;
}

/// The next step of held grains that has to be made: one of a fix that acts at its end, or with an output or
/// values that somebody asks for.
std::int64_t LiggghtsPort::next_step_that_counts() const {
  const std::int64_t now = lmp_->update->ntimestep;
  if (every_step_) return now + 1;
  std::int64_t next = lmp_->output->next > now ? lmp_->output->next : kNoStep;
  if (announced_step_ > now) next = std::min(next, announced_step_);
  for (int i = 0; i < lmp_->modify->nfix; ++i) {
    const std::int64_t every = lmp_->modify->fix[i]->nevery;
    if ((lmp_->modify->fmask[i] & LAMMPS_NS::FixConst::END_OF_STEP) != 0 && every > 0)
      next = std::min(next, (now / every + 1) * every);
  }
  return next;
}

bool LiggghtsPort::reads_loads(int substeps) {
  return moves_ || next_step_that_counts() <= lmp_->update->ntimestep + substeps;
}

double LiggghtsPort::time_step() const {
  return lmp_->update->dt;
}

void LiggghtsPort::set_time_step(double step) {
  constexpr double round_off = 1e-9;
  if (std::abs(step - lmp_->update->dt) <= round_off * step) return;
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (const std::string style = lmp_->modify->fix[i]->style; style == "move")
      throw_user_error(
          {"lbm run", "timestep", fmt::format("{:g} s", lmp_->update->dt),
           fmt::format("be {:.10g} s, a whole part of the fluid's step: `fix move` does not let it "
                       "be changed",
                       step),
           fmt::format("write `timestep {:.10g}` before `fix {} ... move`", step, lmp_->modify->fix[i]->id)});
  lmp_->update->update_time();
  lmp_->update->dt = step;
  if (lmp_->update->integrate != nullptr) lmp_->update->integrate->reset_dt();
  for (int i = 0; i < lmp_->modify->nfix; ++i) lmp_->modify->fix[i]->reset_dt();
}

/// With a part of the grains: writes what was put in memory() back to the fix.
void LiggghtsPort::keep_memory() {
  for (std::size_t n = 0; n < load_.size() / FixHydrodynamicForce::kLoadValues; ++n) {
    std::copy_n(&load_[FixHydrodynamicForce::kLoadValues * n], FixHydrodynamicForce::kLoadValues,
                fix_->load() + FixHydrodynamicForce::kLoadValues * local_[n]);
    fix_->records()[local_[n]] = records_[n];
  }
  load_.clear();
}

/// Grains that nothing moves leave nothing to integrate: then the clock of LIGGGHTS goes on alone to the
/// steps that count.
void LiggghtsPort::advance(int substeps) {
  keep_memory();
  auto* update = lmp_->update;
  const bigint last = update->ntimestep + substeps;
  if (reads_loads(substeps)) fix_->loads_changed();
  if (moves_ || every_step_) {
    update->integrate->run(substeps);
    return;
  }
  for (std::int64_t next = next_step_that_counts(); next <= last; next = next_step_that_counts()) {
    update->ntimestep = next - 1;
    update->integrate->run(1);
    if (LAMMPS_NS::SignalHandler::request_quit) return;  // a fix ends the run
  }
  update->ntimestep = last;
}

void LiggghtsPort::begin(std::int64_t steps) {
  auto* update = lmp_->update;
  if (update->ntimestep + steps > MAXBIGINT || steps > MAXSMALLINT)
    throw_user_error({"lbm run", "time", fmt::format("{} DEM steps", steps),
                      fmt::format("be at most {} DEM steps", MAXSMALLINT), "split it in several `lbm run`"});
  if (find_force_fix(lmp_) == nullptr)
    throw_user_error({"lbm run", "fix hydrodynamic/force", "gone",
                      "stay while there is a fluid: it carries the loads",
                      "drop the `unfix`, or end the fluid with `lbm clear` before it"});
  moves_ = anything_moves();
  announced_step_ = -1;
  update->nsteps = static_cast<int>(steps);
  update->firststep = update->beginstep = update->ntimestep;
  update->laststep = update->endstep = update->ntimestep + steps;
  update->whichflag = 1;
  EarlyStop::requested = false;
  lmp_->init();
  every_step_ = !moves_ && acts_in_every_step();
  running_ = true;
  update->integrate->setup();
  lmp_->timer->init();
  keep_box();
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

void LiggghtsPort::keep_box() {
  std::copy_n(lmp_->domain->boxlo, 3, box_.begin());
  std::copy_n(lmp_->domain->boxhi, 3, box_.begin() + 3);
}

void LiggghtsPort::set_fluid_time(double seconds) {
  using enum FixHydrodynamicForce::Fluid;
  if (auto* fix = find_force_fix(lmp_)) fix->set_fluid_time(seconds, running_ ? flows : rests);
}

void LiggghtsPort::end_after(int substeps) {
  auto* update = lmp_->update;
  auto* output = lmp_->output;
  update->laststep = update->endstep = update->ntimestep + substeps;
  output->next_thermo = std::min(output->next_thermo, update->laststep);
  output->next = std::min(output->next, update->laststep);
  lmp_->modify->addstep_compute(update->laststep);
}

void LiggghtsPort::end() {
  if (!running_) return;
  running_ = false;
  auto* update = lmp_->update;
  update->integrate->cleanup();
  update->whichflag = 0;
  update->firststep = update->laststep = 0;
  update->beginstep = update->endstep = 0;
  if (EarlyStop::requested) LAMMPS_NS::SignalHandler::request_quit = false;
}

int LiggghtsPort::stop_requested(int signal) const {
  int mine = std::max(signal, LAMMPS_NS::SignalHandler::request_quit ? kFixStops : 0), any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, lmp_->world);
  return any;
}

void LiggghtsPort::announce_values(int substeps) {
  announced_step_ = lmp_->update->ntimestep + substeps;
  lmp_->modify->addstep_compute(announced_step_);
}

void LiggghtsPort::use_contacts() {
  require_granular_pair_style(lmp_, "lbm output ... contacts");
  LAMMPS_NS::FixContactSampler::of(lmp_);
}

void LiggghtsPort::announce_contacts(int substeps) {
  announced_step_ = lmp_->update->ntimestep + substeps;
  LAMMPS_NS::FixContactSampler::of(lmp_).request(announced_step_, true);
}

const micromechanics::Packing& LiggghtsPort::contacts() {
  return LAMMPS_NS::FixContactSampler::of(lmp_).packing_with_friction(fix_->groupbit);
}

std::array<bool, 3> LiggghtsPort::periodic() const {
  const int* faces = lmp_->domain->periodicity;
  return {faces[0] != 0, faces[1] != 0, faces[2] != 0};
}

}  // namespace suffuse::coupling
