#include "fix_density_scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix_contact_sampler.h"
#include "fix_gravity.h"
#include "fix_stress_servo.h"
#include "memory.h"
#include "modify.h"
#include "restart_record.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/inertial_number.h"
#include "suffuse/micromechanics/stress.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;
namespace mm = suffuse::micromechanics;

namespace {

constexpr const char* kDensityScaling = "fix density/scaling";
/// Of its state in restart files.
constexpr int kStateVersion = 1;
/// Of a grain's weight: forces below are the rounding of the weight itself.
constexpr double kNoForce = 1e-9;
/// Masses agree with density times volume to this; LIGGGHTS writes π in 12 digits.
constexpr double kSameMass = 1e-6;
/// Mechanical coordination number from which a sample has a force network: colliding grains have about 2, an
/// isostatic packing with friction 4.
constexpr double kNetwork = 3;

double true_mass(const Atom& atom, int i) {
  return atom.density[i] * mm::sphere_volume(atom.radius[i]);
}

/// What FixGravity does not tell: whether a variable sets it.
struct GravityAccess : FixGravity {
  static bool is_constant(const FixGravity& gravity) {
    using Name = char* FixGravity::*;
    constexpr std::array<Name, 7> kNames{&GravityAccess::mstr, &GravityAccess::vstr, &GravityAccess::pstr,
                                         &GravityAccess::tstr, &GravityAccess::xstr, &GravityAccess::ystr,
                                         &GravityAccess::zstr};
    return std::ranges::all_of(kNames, [&](Name name) { return gravity.*name == nullptr; });
  }
};

}  // namespace

struct FixDensityScaling::Gravity {
  std::vector<FixGravity*> fixes;
};

FixDensityScaling::FixDensityScaling(LAMMPS* lmp_in, int narg, char** arg)
    : Fix(lmp_in, narg, arg), gravity_(std::make_unique<Gravity>()) {
  suffuse::ArgumentReader reader(kDensityScaling, narg, arg, 3);
  suffuse::require_si_and_three_dimensions(lmp, kDensityScaling);
  const std::string mode = reader.word("size D or rayleigh T");
  by_size_ = mode == "size";
  if (by_size_) {
    diameter_ = reader.positive("reference diameter");
  } else if (mode == "rayleigh") {
    share_ = reader.positive("share of the critical time");
    if (share_ > 1)
      throw_user_error(
          {kDensityScaling, "share", fmt::format("{:g}", share_), "be <= 1", "0.2 is the thesis's largest"});
    reference_time_ = update->dt / share_;
  } else {
    reader.unknown(mode, "size, rayleigh");
  }
  while (!reader.done()) {
    if (reader.keyword("bound"))
      bound_ = reader.positive("bound of the inertial number");
    else if (reader.keyword("every"))
      every_ = reader.positive_integer("every");
    else
      reader.unknown(reader.word("keyword"), "bound, every");
  }
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
  std::fill_n(touching_, atom->nlocal, 1.0);
}

FixDensityScaling::~FixDensityScaling() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(touching_);
}

void FixDensityScaling::post_create() {
  sampler_ = &FixContactSampler::of(lmp);
}

int FixDensityScaling::setmask() {
  return FixConst::PRE_NEIGHBOR | FixConst::PRE_FORCE | FixConst::END_OF_STEP;
}

void FixDensityScaling::pre_delete(bool unfixflag) {
  if (unfixflag) restore_true_masses();
}

void FixDensityScaling::init() {
  suffuse::require_single_spheres(lmp, kDensityScaling);
  require_compatible_fixes();
  find_gravity();
  if (first_init_) require_true_masses_at_first();
  first_init_ = false;
  law_ = std::make_unique<suffuse::PairLaw>(suffuse::PairLaw::of(lmp, kDensityScaling));
  require_sane_factors();
  scale(0, atom->nlocal);
}

/// Beyond, grains a thousand times smaller than the reference would share its step: another unit.
void FixDensityScaling::require_sane_factors() const {
  constexpr double most = 1e6;
  double largest = 1;
  for (int i = 0; i < atom->nlocal; ++i) largest = std::max(largest, factor(i));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  if (!(largest <= most))
    throw_user_error({kDensityScaling, by_size_ ? "reference diameter" : "share of the critical time",
                      fmt::format("{:g}", by_size_ ? diameter_ : share_),
                      fmt::format("raise densities by at most {:g}, not by {:.3g}", most, largest),
                      "SI units: diameters in m, `timestep` in s"});
}

void FixDensityScaling::require_compatible_fixes() const {
  int scalings = 0;
  for (int i = 0; i < modify->nfix; ++i) {
    const std::string other = modify->fix[i]->style;
    if (other == style) ++scalings;
    if (other == "hydrodynamic/force")
      throw_user_error({kDensityScaling, "fix", modify->fix[i]->id,
                        "not be there: in water, grains move by their true masses",
                        fmt::format("write `unfix {}` before the water comes", id)});
    if (other.find("multisphere") == 0)
      throw_user_error({kDensityScaling, "fix", modify->fix[i]->id, "not be there: grains are single spheres",
                        "use `fix nve/sphere`"});
  }
  if (scalings > 1)
    throw_user_error({kDensityScaling, "fixes of this style", std::to_string(scalings), "be one at a time",
                      "unfix the first before the next"});
}

void FixDensityScaling::find_gravity() {
  gravity_->fixes.clear();
  for (int i = 0; i < modify->nfix; ++i) {
    if (std::strcmp(modify->fix[i]->style, "gravity") != 0) continue;
    auto* gravity = static_cast<FixGravity*>(modify->fix[i]);
    if (!GravityAccess::is_constant(*gravity))
      throw_user_error({kDensityScaling, "fix gravity", gravity->id, "be constant",
                        "write numbers instead of variables: weight is that of the true masses"});
    gravity_->fixes.push_back(gravity);
  }
}

/// Masses of another origin (`set mass`) would be lost without a word.
void FixDensityScaling::require_true_masses_at_first() {
  double others = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & groupbit) != 0 &&
        std::abs(atom->rmass[i] - true_mass(*atom, i)) > kSameMass * atom->rmass[i])
      others += 1;
  suffuse::sum_over_ranks(lmp, {&others, 1});
  if (others > 0)
    throw_user_error({kDensityScaling, "grains whose mass is not density times volume",
                      fmt::format("{:.0f}", others), "be none", "set their `density` instead of their mass"});
}

double FixDensityScaling::factor(int i) const {
  if ((atom->mask[i] & groupbit) == 0) return 1;
  if (!by_size_ && law_ == nullptr) return 1;  // before the first run
  const double radius = atom->radius[i];
  if (by_size_) return mm::density_factor(2 * radius, diameter_, 0.5);
  return mm::density_factor(law_->critical_time(atom->type[i], radius, atom->density[i]), reference_time_,
                            law_->density_exponent());
}

/// Unscaled grains keep the mass that LIGGGHTS gave them, digit for digit.
void FixDensityScaling::scale(int first, int last) {
  for (int i = first; i < last; ++i) {
    const double own = true_mass(*atom, i), by = factor(i);
    if (by > 1 || std::abs(atom->rmass[i] - own) > kSameMass * own) atom->rmass[i] = by * own;
  }
}

void FixDensityScaling::restore_true_masses() {
  for (int i = 0; i < atom->nlocal + atom->nghost; ++i) {
    const double own = true_mass(*atom, i);
    if (std::abs(atom->rmass[i] - own) > kSameMass * own) atom->rmass[i] = own;
  }
}

void FixDensityScaling::setup_pre_neighbor() {
  pre_neighbor();
}

/// Grains have come or moved to other ranks, and ghosts are new.
void FixDensityScaling::pre_neighbor() {
  scale(0, atom->nlocal + atom->nghost);
}

void FixDensityScaling::setup_pre_force(int) {
  pre_force(0);
}

/// Before the forces are formed, so that the rest obeys whatever holds grains later (`fix freeze`).
void FixDensityScaling::pre_force(int) {
  for (FixGravity* gravity : gravity_->fixes) {
    double g[3];
    gravity->get_gravity(g);
    for (int i = 0; i < atom->nlocal; ++i) {
      if ((atom->mask[i] & gravity->groupbit) == 0 || touching_[i] == 0) continue;
      const double surplus = atom->rmass[i] - true_mass(*atom, i);
      for (int d = 0; d < 3; ++d) atom->f[i][d] -= surplus * g[d];
    }
  }
}

void FixDensityScaling::setup(int) {
  warned_ = false;
  remember_box();
  sampler_->request((update->ntimestep / every_ + 1) * every_);
}

void FixDensityScaling::remember_box() {
  lengths_ = {domain->xprd, domain->yprd, domain->zprd};
  sampled_step_ = update->ntimestep;
}

/// From the forces of this step, less what gravity and this fix made of the weight.
void FixDensityScaling::find_touching() {
  for (int i = 0; i < atom->nlocal; ++i) {
    suffuse::Vec3 others(atom->f[i][0], atom->f[i][1], atom->f[i][2]);
    double largest = 0;
    for (FixGravity* gravity : gravity_->fixes) {
      if ((atom->mask[i] & gravity->groupbit) == 0) continue;
      suffuse::Vec3 g;
      gravity->get_gravity(g.data());
      others -= (touching_[i] != 0 ? true_mass(*atom, i) : atom->rmass[i]) * g;
      largest += atom->rmass[i] * g.norm();
    }
    touching_[i] = others.norm() > kNoForce * largest ? 1 : 0;
  }
}

void FixDensityScaling::end_of_step() {
  if (!gravity_->fixes.empty()) find_touching();
  if (update->ntimestep % every_ != 0) return;
  sample();
  warn_above_bound();
  sampler_->request(update->ntimestep + every_);
}

FixDensityScaling::Scaled FixDensityScaling::scaled_grains() {
  Scaled mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double mass = true_mass(*atom, i), by = factor(i);
    mine.true_mass_of_all += mass;
    if (by <= 1) continue;
    mine.grains += 1;
    mine.true_mass += mass;
    mine.inertia += by * mass;
    mine.largest_factor = std::max(mine.largest_factor, by);
    mine.largest_inertial_size =
        std::max(mine.largest_inertial_size, 2 * atom->radius[i] * std::sqrt(atom->density[i] * by));
  }
  std::array<double, 4> sums{mine.grains, mine.true_mass, mine.inertia, mine.true_mass_of_all};
  suffuse::sum_over_ranks(lmp, sums);
  std::array<double, 2> largest{mine.largest_factor, mine.largest_inertial_size};
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, world);
  return {sums[0], sums[1], sums[2], sums[3], largest[0], largest[1]};
}

/// The contacts are those of this step's forces; so are the forces on the grains, weight and all.
void FixDensityScaling::sample() {
  const auto& packing = sampler_->packing(1);
  auto coordination = mm::coordination_sums(packing, {});
  suffuse::sum_over_ranks(lmp, mm::as_doubles(coordination));
  auto stress = mm::stress_times_volume(packing);
  suffuse::sum_over_ranks(lmp, mm::as_doubles(stress));
  std::array<double, 3> forces{};  // Σ |resultant| and number of scaled grains, Σ |contact force|
  for (const auto& contact : packing.contacts)
    if (mm::is_counted(packing, contact)) forces[2] += contact.force.norm();
  for (int i = 0; i < atom->nlocal; ++i) {
    if (factor(i) <= 1) continue;
    forces[0] += suffuse::Vec3(atom->f[i][0], atom->f[i][1], atom->f[i][2]).norm();
    forces[1] += 1;
  }
  suffuse::sum_over_ranks(lmp, forces);
  unbalanced_ =
      forces[1] > 0 && forces[2] > 0 ? (forces[0] / forces[1]) / (forces[2] / coordination.contacts) : 0;

  const double time = static_cast<double>(update->ntimestep - sampled_step_) * update->dt;
  const std::array<double, 3> now{domain->xprd, domain->yprd, domain->zprd};
  double rate = 0;
  for (std::size_t axis = 0; axis < 3 && time > 0; ++axis)
    rate = std::max(rate, std::abs(std::log(now[axis] / lengths_[axis])) / time);
  remember_box();
  const bool network = mm::coordination(coordination, packing.volume).mechanical >= kNetwork;
  // d √ρ enters the inertial number as one; the largest of the scaled grains is written as a diameter.
  inertial_number_ = network ? mm::inertial_number({rate, scaled_grains().largest_inertial_size, 1,
                                                    mm::mean_stress(stress.matrix()) / packing.volume})
                             : 0;
}

/// A servo on its way to a target limits its rates by the inertial number there; at the stress of now it is
/// larger in any sample.
void FixDensityScaling::warn_above_bound() {
  if (warned_ || inertial_number_ <= bound_) return;
  for (int i = 0; i < modify->nfix; ++i)
    if (auto* servo = dynamic_cast<FixStressServo*>(modify->fix[i]); servo != nullptr && servo->approaching())
      return;
  warned_ = true;
  suffuse::tell(
      lmp, fmt::format(
               "WARNING: fix density/scaling {}: inertial number {:.3g} of the scaled grains at step {} is "
               "above {:g}: the loading is not quasi-static for them; load more slowly or scale less "
               "(docs/reference/fix_density_scaling.md)\n",
               id, inertial_number_, update->ntimestep, bound_));
}

double FixDensityScaling::compute_vector(int n) {
  if (n == 3) return inertial_number_;
  if (n == 4) return unbalanced_;
  if (law_ == nullptr) return 0;
  const Scaled scaled = scaled_grains();
  const double all = scaled.true_mass_of_all;
  if (n == 0) return scaled.largest_factor;
  if (n == 1) return all > 0 ? scaled.true_mass / all : 0;
  if (n == 2) return scaled.grains;
  return all > 0 ? (all - scaled.true_mass + scaled.inertia) / all : 1;
}

/// Restart files hold true masses: LIGGGHTS packs the grains right after this, and each is scaled again once
/// it is packed.
void FixDensityScaling::write_restart(FILE* file) {
  for (int i = 0; i < atom->nlocal; ++i)
    if (factor(i) > 1) atom->rmass[i] = true_mass(*atom, i);
  if (comm->me != 0) return;
  suffuse::write_record(file, {kStateVersion, "", {reference_time_, share_}});
}

/// The reference time of `rayleigh` stays that of the first definition.
void FixDensityScaling::restart(char* buffer) {
  const std::vector<double> values = suffuse::read_record(buffer, kStateVersion, 2, kDensityScaling).values;
  if (!by_size_ && values[1] == share_) reference_time_ = values[0];
}

int FixDensityScaling::pack_restart(int i, double* buffer) {
  scale(i, i + 1);
  buffer[0] = 2;  // the length
  buffer[1] = touching_[i];
  return 2;
}

int FixDensityScaling::size_restart(int) {
  return 2;
}

int FixDensityScaling::maxsize_restart() {
  return 2;
}

void FixDensityScaling::unpack_restart(int i, int nth) {
  const double* stored = atom->extra[i];
  int first = 0;
  for (int n = 0; n < nth; ++n) first += static_cast<int>(stored[first]);  // of the fixes before
  touching_[i] = stored[first + 1];
}

void FixDensityScaling::grow_arrays(int nmax) {
  memory->grow(touching_, nmax, "density/scaling:touching");
}

void FixDensityScaling::copy_arrays(int from, int to, int) {
  touching_[to] = touching_[from];
}

void FixDensityScaling::set_arrays(int i) {
  touching_[i] = 0;
}

int FixDensityScaling::pack_exchange(int i, double* buffer) {
  buffer[0] = touching_[i];
  return 1;
}

int FixDensityScaling::unpack_exchange(int i, double* buffer) {
  touching_[i] = buffer[0];
  return 1;
}
