#include "liggghts_port.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "integrate.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "signal_handling.h"
#include "styles/early_stop.h"
#include "styles/fix_contact_sampler.h"
#include "styles/fix_hydrodynamic_force.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/coupling/hydrodynamic_load.h"
#include "timer.h"
#include "update.h"

namespace suffuse::coupling {

using LAMMPS_NS::bigint;
using LAMMPS_NS::FixHydrodynamicForce;
using LAMMPS_NS::LAMMPS;

static_assert(FixHydrodynamicForce::kHistoryValues == kHistoryLength &&
              FixHydrodynamicForce::kAcceleration == history::acceleration &&
              FixHydrodynamicForce::kAngularAcceleration == history::angular_acceleration &&
              FixHydrodynamicForce::kVirtualMass == history::virtual_mass &&
              FixHydrodynamicForce::kVirtualMoment == history::virtual_moment);

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
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::string(lmp->modify->fix[i]->style).find("multisphere") == 0)
      throw_user_error({"lbm run", "fix", lmp->modify->fix[i]->style,
                        "not be defined: grains are single spheres",
                        "use `fix nve/sphere` with single spheres"});
  if (find_force_fix(lmp) == nullptr) {
    std::string id = "hydrodynamic_force", group = "all", style = "hydrodynamic/force";
    char* words[] = {id.data(), group.data(), style.data()};
    lmp->modify->add_fix(3, words);
    made_fix_ = true;
  }
  fix_ = find_force_fix(lmp);
}

void LiggghtsPort::withdraw() {
  if (made_fix_ && find_force_fix(lmp_) != nullptr) lmp_->modify->delete_fix(find_force_fix(lmp_)->id);
  made_fix_ = false;
}

GrainArrays LiggghtsPort::grains() {
  const auto* atom = lmp_->atom;
  fix_ = find_force_fix(lmp_);
  keep_memory();
  fix_->update_ghost_velocities();
  GrainArrays arrays;
  all_grains_ = fix_->igroup == 0;
  const int all = atom->nlocal + atom->nghost;
  if (all_grains_) {
    arrays.owned = atom->nlocal;
    arrays.total = all;
    if (all == 0) return arrays;
    arrays.position = atom->x[0];
    arrays.velocity = atom->v[0];
    arrays.angular_velocity = atom->omega[0];
    arrays.radius = atom->radius;
    arrays.mass = atom->rmass;
    arrays.id = atom->tag;
    return arrays;
  }
  local_.clear();
  for (int i = 0; i < all; ++i) {
    if ((atom->mask[i] & fix_->groupbit) != 0) local_.push_back(i);
    if (i + 1 == atom->nlocal) arrays.owned = static_cast<int>(local_.size());
  }
  arrays.total = static_cast<int>(local_.size());
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
  arrays.position = position_.data();
  arrays.velocity = velocity_.data();
  arrays.angular_velocity = spin_.data();
  arrays.radius = radius_.data();
  arrays.mass = mass_.data();
  arrays.id = id_.data();
  return arrays;
}

void LiggghtsPort::sum_over_copies(std::vector<double>& force, std::vector<double>& torque) {
  if (all_grains_) {
    fix_->sum_over_ghosts(force, torque);
    return;
  }
  const auto all = 3 * static_cast<std::size_t>(lmp_->atom->nlocal + lmp_->atom->nghost);
  std::vector<double> every_force(all, 0), every_torque(all, 0);
  const auto spread = [&](std::vector<double>& part, std::vector<double>& whole, bool gather) {
    for (std::size_t n = 0; n < local_.size(); ++n)
      for (std::size_t a = 0; a < 3; ++a) {
        double& other = whole[3 * static_cast<std::size_t>(local_[n]) + a];
        (gather ? part[3 * n + a] : other) = gather ? other : part[3 * n + a];
      }
  };
  spread(force, every_force, false);
  spread(torque, every_torque, false);
  fix_->sum_over_ghosts(every_force, every_torque);
  spread(force, every_force, true);
  spread(torque, every_torque, true);
}

GrainMemory LiggghtsPort::memory() {
  if (lmp_->atom->nlocal == 0) return {};
  if (all_grains_) return {fix_->load(), fix_->history()};
  keep_memory();
  history_.clear();
  for (const int i : local_) {
    if (i >= lmp_->atom->nlocal) break;
    const double *load = fix_->load() + FixHydrodynamicForce::kLoadValues * i,
                 *history = fix_->history() + kHistoryLength * i;
    load_.insert(load_.end(), load, load + FixHydrodynamicForce::kLoadValues);
    history_.insert(history_.end(), history, history + kHistoryLength);
  }
  return {load_.data(), history_.data()};
}

bool LiggghtsPort::anything_moves() const {
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (lmp_->modify->fix[i]->time_integrate != 0) return true;
  return false;
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

bool LiggghtsPort::reads_loads(int substeps) {
  return moves_ || lmp_->output->next <= lmp_->update->ntimestep + substeps;
}

double LiggghtsPort::time_step() const {
  return lmp_->update->dt;
}

void LiggghtsPort::set_time_step(double step) {
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
    std::copy_n(&history_[kHistoryLength * n], kHistoryLength, fix_->history() + kHistoryLength * local_[n]);
  }
  load_.clear();
}

/// Grains that nothing moves leave nothing to integrate: then only the clock of LIGGGHTS goes on, and its
/// steps run where an output is due.
void LiggghtsPort::advance(int substeps) {
  keep_memory();
  if (!reads_loads(substeps)) {
    lmp_->update->ntimestep += substeps;
    return;
  }
  fix_->loads_changed();
  lmp_->update->integrate->run(substeps);
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
  update->nsteps = static_cast<int>(steps);
  update->firststep = update->beginstep = update->ntimestep;
  update->laststep = update->endstep = update->ntimestep + steps;
  update->whichflag = 1;
  EarlyStop::requested = false;
  lmp_->init();
  update->integrate->setup();
  lmp_->timer->init();
  const auto* domain = lmp_->domain;
  std::copy_n(domain->boxlo, 3, box_.begin());
  std::copy_n(domain->boxhi, 3, box_.begin() + 3);
  running_ = true;
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

void LiggghtsPort::check_box(const lbm::FaceConditions& faces) const {
  const auto* domain = lmp_->domain;
  if (domain->triclinic != 0)
    throw_user_error({"lbm run", "box", "triclinic", "be orthogonal", "use a `region ... block`"});
  for (int f = 0; f < lbm::kFaces; ++f) {
    const int axis = f / 2;
    const std::string name = lbm::name_of(static_cast<lbm::Face>(f));
    const bool fluid = faces[static_cast<std::size_t>(f)].kind == lbm::FaceKind::periodic;
    if (fluid != (domain->periodicity[axis] != 0))
      throw_user_error({"lbm boundary", name, lbm::name_of(faces[static_cast<std::size_t>(f)].kind),
                        fmt::format("agree with LIGGGHTS's `boundary`, which is {}periodic along {}",
                                    fluid ? "not " : "", "xyz"[axis]),
                        fluid ? "write `boundary ... p` for this axis, or give the face another kind"
                              : "write `boundary ... f` for this axis, or make both of its faces periodic"});
    if (domain->boundary[axis][f % 2] > 1)
      throw_user_error({"lbm run", "boundary", "shrink-wrapped", "be fixed (f) or periodic (p)",
                        "write `boundary f f f`: the fluid's box does not move"});
  }
}

void LiggghtsPort::check_unchanged() const {
  const auto* domain = lmp_->domain;
  for (std::size_t a = 0; a < 3; ++a)
    if (box_[a] != domain->boxlo[a] || box_[a + 3] != domain->boxhi[a])
      throw_user_error({"lbm run", "box", "deforming", "keep its size while there is a fluid",
                        "unfix the servo or `fix deform` before, or end the fluid with `lbm clear`"});
}

Vec3 LiggghtsPort::box_low() const {
  return Eigen::Map<const Vec3>(lmp_->domain->boxlo);
}

Vec3 LiggghtsPort::box_high() const {
  return Eigen::Map<const Vec3>(lmp_->domain->boxhi);
}

Vec3 LiggghtsPort::box_size() const {
  return Eigen::Map<const Vec3>(lmp_->domain->prd);
}

lbm::Decomposition LiggghtsPort::decomposition(const Vec3& low, double spacing,
                                               const lbm::Index3& cells) const {
  const auto* comm = lmp_->comm;
  const double* splits[3] = {comm->xsplit, comm->ysplit, comm->zsplit};
  std::array<std::vector<int>, 3> cuts;
  for (int a = 0; a < 3; ++a) {
    auto& planes = cuts[static_cast<std::size_t>(a)];
    const auto n = cells[static_cast<std::size_t>(a)];
    for (int i = 0; i <= comm->procgrid[a]; ++i) {
      const double plane = lmp_->domain->boxlo[a] + splits[a][i] * lmp_->domain->prd[a];
      planes.push_back(std::clamp(static_cast<int>(std::lround((plane - low[a]) / spacing)), 0, n));
    }
    planes.front() = 0;
    planes.back() = n;
  }
  return lbm::Decomposition::from_cuts(lmp_->world, cuts, [comm](const lbm::Index3& place) {
    return comm->grid2proc[place[0]][place[1]][place[2]];
  });
}

void LiggghtsPort::announce_values(int substeps) {
  lmp_->modify->addstep_compute(lmp_->update->ntimestep + substeps);
}

void LiggghtsPort::use_contacts() {
  require_granular_pair_style(lmp_, "lbm output ... contacts");
  LAMMPS_NS::FixContactSampler::of(lmp_);
}

void LiggghtsPort::announce_contacts(int substeps) {
  LAMMPS_NS::FixContactSampler::of(lmp_).request(lmp_->update->ntimestep + substeps);
}

const micromechanics::Packing& LiggghtsPort::contacts() {
  return LAMMPS_NS::FixContactSampler::of(lmp_).packing(fix_->groupbit);
}

std::array<bool, 3> LiggghtsPort::periodic() const {
  const int* faces = lmp_->domain->periodicity;
  return {faces[0] != 0, faces[1] != 0, faces[2] != 0};
}

LiggghtsPort::Summary LiggghtsPort::summary() const {
  const auto* atom = lmp_->atom;
  struct {
    double grains, radius_squared, volume, energy, load[3];
  } sums{};
  struct {
    double minus_radius, radius, minus_density, density, high[3], minus_low[3];
  } extremes;
  std::fill_n(&extremes.minus_radius, sizeof extremes / sizeof(double), -1e300);
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & fix_->groupbit) == 0) continue;
    const double r = atom->radius[i], volume = sphere_volume(r), density = atom->rmass[i] / volume;
    sums.grains += 1;
    sums.radius_squared += r * r;
    sums.volume += volume;
    sums.energy += 0.5 * atom->rmass[i] *
                   (Eigen::Map<const Vec3>(atom->v[i]).squaredNorm() +
                    0.4 * r * r * Eigen::Map<const Vec3>(atom->omega[i]).squaredNorm());
    extremes.minus_radius = std::max(extremes.minus_radius, -r);
    extremes.radius = std::max(extremes.radius, r);
    extremes.minus_density = std::max(extremes.minus_density, -density);
    extremes.density = std::max(extremes.density, density);
    for (int a = 0; a < 3; ++a) {
      sums.load[a] += fix_->load()[FixHydrodynamicForce::kLoadValues * i + a];
      extremes.high[a] = std::max(extremes.high[a], atom->x[i][a] + r);
      extremes.minus_low[a] = std::max(extremes.minus_low[a], r - atom->x[i][a]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &sums, sizeof sums / sizeof(double), MPI_DOUBLE, MPI_SUM, lmp_->world);
  MPI_Allreduce(MPI_IN_PLACE, &extremes, sizeof extremes / sizeof(double), MPI_DOUBLE, MPI_MAX, lmp_->world);
  Summary summary;
  summary.grains = static_cast<std::int64_t>(sums.grains);
  if (summary.grains == 0) return summary;
  summary.solid_volume = sums.volume;
  summary.sauter_diameter = 6 * sums.volume / (4 * M_PI * sums.radius_squared);
  summary.smallest_radius = -extremes.minus_radius;
  summary.largest_radius = extremes.radius;
  summary.smallest_density = -extremes.minus_density;
  summary.largest_density = extremes.density;
  summary.kinetic_energy = sums.energy;
  summary.load = Vec3(sums.load[0], sums.load[1], sums.load[2]);
  for (int a = 0; a < 3; ++a)
    summary.extent[a] = std::min(extremes.high[a] + extremes.minus_low[a], lmp_->domain->prd[a]);
  summary.packing = sums.volume / summary.extent.prod();
  if (summary.grains == 1)  // fills the box around it, whatever it does
    summary.packing = sums.volume / (lmp_->domain->prd[0] * lmp_->domain->prd[1] * lmp_->domain->prd[2]);
  return summary;
}

std::vector<double> LiggghtsPort::grains_by_size(const std::vector<double>& bounds) const {
  std::vector<double> counts(bounds.size() + 1, 0);
  for (int i = 0; i < lmp_->atom->nlocal; ++i) {
    if ((lmp_->atom->mask[i] & fix_->groupbit) == 0) continue;
    const auto above = std::upper_bound(bounds.begin(), bounds.end(), 2 * lmp_->atom->radius[i]);
    counts[static_cast<std::size_t>(above - bounds.begin())] += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()), MPI_DOUBLE, MPI_SUM,
                lmp_->world);
  return counts;
}

Vec3 LiggghtsPort::mean_load(int groupbit) const {
  double sums[4] = {0, 0, 0, 0};
  for (int i = 0; i < lmp_->atom->nlocal; ++i) {
    if ((lmp_->atom->mask[i] & groupbit & fix_->groupbit) == 0) continue;
    for (int a = 0; a < 3; ++a) sums[a] += fix_->load()[FixHydrodynamicForce::kLoadValues * i + a];
    sums[3] += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, lmp_->world);
  return Vec3(sums[0], sums[1], sums[2]) / std::max(1., sums[3]);
}

PastRun LiggghtsPort::past_run() const {
  // Verlet leaves the loop's wall time in the timer, and `run` the number of steps.
  const double steps = lmp_->update->nsteps;
  double seconds = lmp_->timer->array[TIME_LOOP];
  MPI_Bcast(&seconds, 1, MPI_DOUBLE, 0, lmp_->world);
  const double grains = static_cast<double>(lmp_->atom->natoms);
  constexpr double least_seconds = 0.1;
  if (!(seconds > least_seconds) || steps * grains <= 0) return {};
  return {steps * grains, seconds};
}

}  // namespace suffuse::coupling
