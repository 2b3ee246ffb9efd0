#include "fix_hydrodynamic_force.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "atom.h"
#include "comm.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "restart_record.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/sphere.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;

namespace {
using suffuse::GrainRecord;
constexpr int kValues = FixHydrodynamicForce::kLoadValues + suffuse::kGrainRecordValues;
/// Of a grain in a restart file: the length, as LIGGGHTS wants it, the record's version, the values.
constexpr int kRestartValues = 2 + kValues;
/// Of the fix in a restart file: time of the fluid.
constexpr int kTimeVersion = 1;

/// Has the record a drag, or something to return?
bool foresees(const GrainRecord& record) {
  double returned = 0;
  for (int a = 0; a < 3; ++a)
    returned += std::abs(record.returned_force[a]) + std::abs(record.returned_torque[a]);
  return record.virtual_drag > 0 || record.virtual_spin_drag > 0 || returned > 0;
}

}  // namespace

FixHydrodynamicForce::FixHydrodynamicForce(LAMMPS* lmp_in, int narg, char** arg) : Fix(lmp_in, narg, arg) {
  suffuse::ArgumentReader reader("fix hydrodynamic/force", narg, arg, 3);
  if (!reader.done()) reader.unknown(reader.word("end of line"), "nothing more");
  suffuse::require_si_and_three_dimensions(lmp, "fix hydrodynamic/force");
  if (atom->radius_flag == 0 || atom->torque_flag == 0)
    throw_user_error({"fix hydrodynamic/force", "atom_style", atom->atom_style, "be spheres",
                      "write `atom_style granular`"});
  for (int i = 0; i < modify->nfix; ++i)
    if (modify->fix[i] != nullptr && std::string(modify->fix[i]->style) == style)  // null: being replaced
      throw_user_error({"fix hydrodynamic/force", "fix", id,
                        std::string("be the only one of its style (there is ") + modify->fix[i]->id + ")",
                        "name one group that holds all grains in the fluid"});
  peratom_flag = 1;
  size_peratom_cols = kLoadValues;
  peratom_freq = 1;
  scalar_flag = 1;
  extscalar = 0;
  restart_global = 1;
  vector_flag = 1;
  size_vector = kLoadValues;
  global_freq = 1;
  extvector = 1;
  restart_peratom = 1;
  create_attribute = 1;
  comm_forward = 6;
  comm_reverse = kSumValues;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
  for (int i = 0; i < atom->nlocal; ++i) set_arrays(i);
}

FixHydrodynamicForce::~FixHydrodynamicForce() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(array_atom);
}

int FixHydrodynamicForce::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::POST_FORCE | FixConst::PRE_FINAL_INTEGRATE;
}

void FixHydrodynamicForce::post_create() {
  require_records_of_this_version();
  suffuse::act_before_constraints(lmp, this);
}

void FixHydrodynamicForce::require_records_of_this_version() {
  int grains = 0;
  MPI_Allreduce(&foreign_records_, &grains, 1, MPI_INT, MPI_SUM, world);
  if (grains > 0)
    throw_user_error({"fix hydrodynamic/force", "records in the restart file",
                      "of another layout for " + std::to_string(grains) + " grains",
                      "be of version " + std::to_string(suffuse::kGrainRecordVersion),
                      "read the restart file with the version of suffuse that wrote it"});
}

void FixHydrodynamicForce::init() {
  suffuse::require_single_spheres(lmp, "fix hydrodynamic/force");
  constraints_.clear();
  for (int i = 0; i < modify->nfix; ++i)
    if (suffuse::constrains_forces(modify->fix[i]->style)) constraints_.push_back(modify->fix[i]);
}

void FixHydrodynamicForce::setup(int flag) {
  stale_ = true;
  post_force(flag);
  setting_up_ = true;
}

void FixHydrodynamicForce::pre_initial_integrate() {
  finish_setup();
  if (in_interval_) withhold(update->dt);
}

/// The shares multiply the sum of all forces: once every fix has been set up, before the first half step.
void FixHydrodynamicForce::finish_setup() {
  if (setting_up_) pre_final_integrate();
  setting_up_ = false;
}

/// Without the drag: where the grain has the velocity that it refers to. What is returned is that of an
/// interval.
FixHydrodynamicForce::Addition FixHydrodynamicForce::load_alone(int i) const {
  if (!in_water_) return {{}, {}, 1, 1, false};
  const GrainRecord& record = records_[static_cast<std::size_t>(i)];
  Addition ours;
  for (int a = 0; a < 3; ++a) {
    ours.force[a] = array_atom[i][a] + (in_interval_ ? record.returned_force[a] : 0);
    ours.torque[a] = array_atom[i][3 + a] + (in_interval_ ? record.returned_torque[a] : 0);
  }
  const double own = atom->rmass[i];
  ours.force_share = own / (own + record.added_mass);
  ours.torque_share = 1;
  ours.changes = foresees(record);
  return ours;
}

FixHydrodynamicForce::Addition FixHydrodynamicForce::addition(int i) const {
  Addition ours = load_alone(i);
  const GrainRecord& record = records_[static_cast<std::size_t>(i)];
  if (!in_interval_ || !ours.changes) return ours;
  const double *v = atom->v[i], *omega = atom->omega[i];
  for (int a = 0; a < 3; ++a) {
    ours.force[a] -= record.virtual_drag * (v[a] - record.velocity[a]);
    ours.torque[a] -= record.virtual_spin_drag * (omega[a] - record.angular_velocity[a]);
  }
  const double own = atom->rmass[i], half_step = 0.5 * update->dt,
               moment = suffuse::micromechanics::sphere_inertia(own, atom->radius[i]);
  ours.force_share = own / (own + record.added_mass + half_step * record.virtual_drag);
  ours.torque_share = moment / (moment + half_step * record.virtual_spin_drag);
  return ours;
}

/// What the drag takes in so much time, with the velocities as they are.
void FixHydrodynamicForce::withhold(double seconds) {
  const int owned = std::min(atom->nlocal, static_cast<int>(applied_.size()));
  for (int i = 0; i < owned; ++i) {
    if ((atom->mask[i] & groupbit) == 0 || !applied_[static_cast<std::size_t>(i)].changes) continue;
    GrainRecord& record = records_[static_cast<std::size_t>(i)];
    const double *v = atom->v[i], *omega = atom->omega[i];
    for (int a = 0; a < 3; ++a) {
      record.withheld_impulse[a] += seconds * record.virtual_drag * (v[a] - record.velocity[a]);
      record.withheld_spin[a] += seconds * record.virtual_spin_drag * (omega[a] - record.angular_velocity[a]);
    }
  }
}

/// Anew for grains that have changed places, or whose drag changes; the others' stay where they are.
void FixHydrodynamicForce::post_force(int) {
  const auto all = static_cast<std::size_t>(atom->nlocal);
  const bool anew = stale_ || neighbor->ago == 0 || applied_.size() != all;
  applied_.resize(all);
  stale_ = false;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    Addition& ours = applied_[static_cast<std::size_t>(i)];
    if (anew || ours.changes) ours = addition(i);
    for (int a = 0; a < 3; ++a) {
      atom->f[i][a] += ours.force[a];
      atom->torque[i][a] += ours.torque[a];
    }
  }
}

/// After every fix that adds forces.
void FixHydrodynamicForce::pre_final_integrate() {
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    const Addition& ours = applied_[static_cast<std::size_t>(i)];
    for (int a = 0; a < 3; ++a) {
      atom->f[i][a] *= ours.force_share;
      atom->torque[i][a] *= ours.torque_share;
    }
  }
}

void FixHydrodynamicForce::forget() {
  for (int i = 0; i < atom->nlocal; ++i) set_arrays(i);
}

void FixHydrodynamicForce::loads_changed() {
  finish_setup();
  in_interval_ = true;
  const int owned = std::min(atom->nlocal, static_cast<int>(applied_.size()));
  if (!constraints_.empty()) {
    change_constrained(owned);
    return;
  }
  for (int i = 0; i < owned; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    Addition& ours = applied_[static_cast<std::size_t>(i)];
    const Addition now = load_alone(i);
    for (int a = 0; a < 3; ++a) {
      double &f = atom->f[i][a], &torque = atom->torque[i][a];
      f = now.force_share * (f / ours.force_share - ours.force[a] + now.force[a]);
      torque = now.torque_share * (torque / ours.torque_share - ours.torque[a] + now.torque[a]);
    }
    ours = now;
  }
}

/// Constraints C are affine in the forces: C(f + change) = C(f) + C(change) - C(0), and C(f) is what is
/// there.
void FixHydrodynamicForce::change_constrained(int owned) {
  const std::size_t values = 6 * static_cast<std::size_t>(owned);
  std::vector<double> there(values), change(values, 0.);
  const auto each = [&](const auto& visit) {
    for (int i = 0; i < owned; ++i)
      for (int a = 0; a < 3; ++a) {
        const std::size_t at = 6 * static_cast<std::size_t>(i) + static_cast<std::size_t>(a);
        visit(i, a, atom->f[i][a], atom->torque[i][a], at);
      }
  };
  const auto constrain = [this] {
    for (Fix* fix : constraints_) fix->post_force(0);
  };
  const auto grouped = [this](int i) { return (atom->mask[i] & groupbit) != 0; };
  std::vector<Addition> next(static_cast<std::size_t>(owned), {{}, {}, 1, 1, false});
  for (int i = 0; i < owned; ++i)
    if (grouped(i)) next[static_cast<std::size_t>(i)] = load_alone(i);
  each([&](int i, int a, double& f, double& torque, std::size_t at) {
    there[at] = f;
    there[at + 3] = torque;
    f = torque = 0;
    if (!grouped(i)) return;
    const Addition &ours = applied_[static_cast<std::size_t>(i)], &now = next[static_cast<std::size_t>(i)];
    there[at] /= ours.force_share;
    there[at + 3] /= ours.torque_share;
    f = now.force[a] - ours.force[a];
    torque = now.torque[a] - ours.torque[a];
  });
  constrain();
  each([&](int, int, double& f, double& torque, std::size_t at) {
    change[at] = f;
    change[at + 3] = torque;
    f = torque = 0;
  });
  constrain();
  each([&](int i, int, double& f, double& torque, std::size_t at) {
    const Addition& now = next[static_cast<std::size_t>(i)];
    f = now.force_share * (there[at] + (change[at] - f));
    torque = now.torque_share * (there[at + 3] + (change[at + 3] - torque));
  });
  for (int i = 0; i < owned; ++i)
    if (grouped(i)) applied_[static_cast<std::size_t>(i)] = next[static_cast<std::size_t>(i)];
}

/// Verlet's steps give a force half before its instant and half after: the last one of an interval counts
/// half, and the first one is zero.
void FixHydrodynamicForce::interval_over() {
  if (in_interval_) withhold(0.5 * update->dt);
  in_interval_ = false;
}

double* FixHydrodynamicForce::load() {
  return array_atom[0];
}

GrainRecord* FixHydrodynamicForce::records() {
  return records_.data();
}

void FixHydrodynamicForce::set_fluid_time(double seconds, Fluid fluid) {
  fluid_time_ = seconds;
  fluid_step_ = update->ntimestep;
  fluid_ = fluid;
}

/// Time of the fluid, s: how long it has flowed.
double FixHydrodynamicForce::compute_scalar() {
  if (fluid_ == Fluid::rests) return fluid_time_;
  return fluid_time_ + static_cast<double>(update->ntimestep - fluid_step_) * update->dt;
}

void FixHydrodynamicForce::write_restart(FILE* file) {
  if (comm->me != 0) return;
  suffuse::write_record(file, {kTimeVersion, "", {compute_scalar()}});
}

void FixHydrodynamicForce::restart(char* state) {
  fluid_time_ = suffuse::read_record(state, kTimeVersion, 1, "fix hydrodynamic/force").values[0];
}

/// Sum of the forces (1 to 3) and torques (4 to 6) on the grains of the group.
double FixHydrodynamicForce::compute_vector(int n) {
  double mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & groupbit) != 0) mine += array_atom[i][n];
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixHydrodynamicForce::memory_usage() {
  return static_cast<double>(atom->nmax) * (kValues + 8) * sizeof(double);
}

void FixHydrodynamicForce::grow_arrays(int nmax) {
  memory->grow(array_atom, nmax, static_cast<int>(kLoadValues), "hydrodynamic/force:load");
  records_.resize(static_cast<std::size_t>(nmax));
}

void FixHydrodynamicForce::copy_arrays(int from, int to, int) {
  std::copy_n(array_atom[from], kLoadValues, array_atom[to]);
  records_[static_cast<std::size_t>(to)] = records_[static_cast<std::size_t>(from)];
  stale_ = true;
}

void FixHydrodynamicForce::set_arrays(int i) {
  std::fill_n(array_atom[i], kLoadValues, 0.);
  records_[static_cast<std::size_t>(i)] = {};
  stale_ = true;
}

int FixHydrodynamicForce::pack_exchange(int i, double* buffer) {
  std::copy_n(array_atom[i], kLoadValues, buffer);
  std::memcpy(buffer + kLoadValues, &records_[static_cast<std::size_t>(i)], sizeof(GrainRecord));
  return kValues;
}

int FixHydrodynamicForce::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, kLoadValues, array_atom[i]);
  std::memcpy(&records_[static_cast<std::size_t>(i)], buffer + kLoadValues, sizeof(GrainRecord));
  stale_ = true;
  return kValues;
}

int FixHydrodynamicForce::pack_restart(int i, double* buffer) {
  buffer[0] = kRestartValues;
  buffer[1] = suffuse::kGrainRecordVersion;
  return 2 + pack_exchange(i, buffer + 2);
}

void FixHydrodynamicForce::unpack_restart(int i, int nth) {
  double* values = atom->extra[i];
  for (int n = 0; n < nth; ++n) values += static_cast<int>(*values);
  if (values[0] != kRestartValues || values[1] != suffuse::kGrainRecordVersion) {
    ++foreign_records_;  // said in post_create, on all ranks alike
    return;
  }
  unpack_exchange(i, values + 2);
  restored_ = true;
}

int FixHydrodynamicForce::size_restart(int) {
  return kRestartValues;
}

int FixHydrodynamicForce::maxsize_restart() {
  return kRestartValues;
}

int FixHydrodynamicForce::pack_comm(int n, int* list, double* buffer, int, int*) {
  for (int k = 0; k < n; ++k) {
    std::copy_n(atom->v[list[k]], 3, buffer + 6 * k);
    std::copy_n(atom->omega[list[k]], 3, buffer + 6 * k + 3);
  }
  return 6;
}

void FixHydrodynamicForce::unpack_comm(int n, int first, double* buffer) {
  for (int k = 0; k < n; ++k) {
    std::copy_n(buffer + 6 * k, 3, atom->v[first + k]);
    std::copy_n(buffer + 6 * k + 3, 3, atom->omega[first + k]);
  }
}

int FixHydrodynamicForce::pack_reverse_comm(int n, int first, double* buffer) {
  std::copy_n(sums_ + kSumValues * first, kSumValues * n, buffer);
  return kSumValues;
}

void FixHydrodynamicForce::unpack_reverse_comm(int n, int* list, double* buffer) {
  for (int k = 0; k < n; ++k)
    for (int v = 0; v < kSumValues; ++v) sums_[kSumValues * list[k] + v] += buffer[kSumValues * k + v];
}

void FixHydrodynamicForce::update_ghost_velocities() {
  comm->forward_comm_fix(this);
}

void FixHydrodynamicForce::sum_over_ghosts(double* values) {
  sums_ = values;
  comm->reverse_comm_fix(this);
}
