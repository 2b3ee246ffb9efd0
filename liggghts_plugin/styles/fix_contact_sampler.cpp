#include "fix_contact_sampler.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "comm.h"
#include "compute_pair_gran_local.h"
#include "domain.h"
#include "fix_property_global.h"
#include "lammps.h"
#include "modify.h"
#include "pair_gran.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::micromechanics::Contact;
using suffuse::micromechanics::kNotOwned;
using suffuse::micromechanics::Packing;

namespace {
constexpr const char* kId = "suffuse_contacts";
}

namespace LAMMPS_NS {

/// Receives contacts from the pair style through the interface of `compute pair/gran/local`.
///
/// A pair style serves one such compute at a time, and a script may have its own: `lend` puts ours in its
/// place for one pass and puts the script's back.
class ContactCollector : public ComputePairGranLocal {
 public:
  static std::unique_ptr<ContactCollector> create(LAMMPS* lmp, FixContactSampler* sampler) {
    // The base class refuses to be made after a first run, since it would be asked for values of the past;
    // this one is only ever asked for the present.
    const bigint now = lmp->update->ntimestep;
    lmp->update->ntimestep = 0;
    char id[] = "suffuse_collector";
    char group[] = "all";
    char style[] = "pair/gran/local";
    char* words[] = {id, group, style};
    int first = 3;
    auto collector = std::unique_ptr<ContactCollector>(new ContactCollector(lmp, first, words, sampler));
    lmp->update->ntimestep = now;
    return collector;
  }

  /// Passes every contact to the sampler.
  ///
  /// The pair style leaves the spring of a sliding contact at its Coulomb limit, so that a second evaluation
  /// finds it above or below the limit by rounding, and below adds a damping force that the first did not
  /// have: by chance, and otherwise on other ranks. The springs are therefore stretched by kStretch for the
  /// sweep, which keeps sliding contacts sliding, and put back bit for bit.
  void sweep(PairGran& pair) {
    ComputePairGranLocal* previous = pair.cpl();
    if (previous != nullptr) pair.unregister_compute_pair_local(previous);
    int history_values = 0;
    pair.register_compute_pair_local(this, history_values);
    springs_.clear();
    saved_.clear();
    finding_springs_ = true;
    spring_values_ = pair.is_history() ? pair.dnum() : 0;
    if (spring_values_ > 0) pair.compute_pgl(0, 0);
    finding_springs_ = false;
    stretch_springs();
    pair.compute_pgl(0, 0);
    restore_springs();
    pair.unregister_compute_pair_local(this);
    if (previous != nullptr) pair.register_compute_pair_local(previous, history_values);
  }

  void add_pair(int i, int j, double fx, double fy, double fz, double, double, double, double* history,
                const double* const) override {
    if (finding_springs_) {
      if (history != nullptr) springs_.push_back(history);
      return;
    }
    const double force_on_i[3] = {fx, fy, fz};
    sampler_->add_contact(i, j, force_on_i);
  }
  void pair_finalize() override {}

 private:
  ContactCollector(LAMMPS* lmp_in, int& first, char** words, FixContactSampler* sampler)
      : ComputePairGranLocal(lmp_in, first, 3, words), sampler_(sampler) {}

  void stretch_springs() {
    for (double* spring : springs_) {
      saved_.insert(saved_.end(), spring, spring + spring_values_);
      for (int k = 0; k < spring_values_; ++k) spring[k] *= 1 + kStretch;
    }
  }

  void restore_springs() {
    const double* saved = saved_.data();
    for (double* spring : springs_) {
      std::copy(saved, saved + spring_values_, spring);
      saved += spring_values_;
    }
  }

  static constexpr double kStretch =
      1e-13;  // above the rounding of the limit, some 1e-16, below any result's digits

  FixContactSampler* sampler_;
  bool finding_springs_ = false;
  int spring_values_ = 0;
  std::vector<double*> springs_;
  std::vector<double> saved_;
};

}  // namespace LAMMPS_NS

FixContactSampler::FixContactSampler(LAMMPS* lmp_in, int narg, char** arg) : Fix(lmp_in, narg, arg) {}

FixContactSampler::~FixContactSampler() = default;

FixContactSampler& FixContactSampler::of(LAMMPS* lmp) {
  if (lmp->modify->find_fix(kId) < 0) {
    std::string id = kId, group = "all", style = "contact/sampler";
    char* words[] = {id.data(), group.data(), style.data()};
    lmp->modify->add_fix(3, words);
  }
  return *static_cast<FixContactSampler*>(lmp->modify->find_fix_id(kId));
}

void FixContactSampler::add_user(Compute* compute) {
  users_.push_back(compute);
}

void FixContactSampler::forget_user(LAMMPS* lmp, Compute* compute) {
  // While LIGGGHTS shuts down, computes outlive fixes.
  if (lmp->modify->find_fix(kId) < 0) return;
  std::erase(static_cast<FixContactSampler*>(lmp->modify->find_fix_id(kId))->users_, compute);
}

void FixContactSampler::request(bigint step) {
  requested_steps_.insert(step);
}

double FixContactSampler::force_exponent() const {
  return pair_->stressStrainExponent();
}

void FixContactSampler::pre_delete(bool unfixflag) {
  if (unfixflag)
    suffuse::throw_user_error({"unfix", "fix", kId, "stay: computes and servos read their contacts from it",
                               "leave it; it costs nothing while nothing asks for contacts"});
}

int FixContactSampler::setmask() {
  return FixConst::POST_FORCE;
}

void FixContactSampler::init() {
  pair_ = &suffuse::require_granular_pair_style(lmp, "contact sampler");
  if (collector_ == nullptr) collector_ = ContactCollector::create(lmp, this);
  sampled_step_ = -1;
  by_group_.clear();

  const int types = atom->ntypes;
  friction_.assign(static_cast<std::size_t>(types * types), 0.0);
  auto* property = dynamic_cast<FixPropertyGlobal*>(modify->find_fix_property(
      "coefficientFriction", "property/global", "peratomtypepair", types, types, style, false));
  if (property == nullptr) return;
  for (int i = 0; i < types; ++i) {
    for (int j = 0; j < types; ++j) {
      const double coefficient = property->compute_array(i, j);
      if (coefficient < 0)
        suffuse::throw_user_error({"fix property/global", "coefficientFriction", std::to_string(coefficient),
                                   "be >= 0",
                                   "LIGGGHTS takes it as it is; sliding contacts have no meaning with it"});
      friction_[static_cast<std::size_t>(i * types + j)] = coefficient;
    }
  }
}

void FixContactSampler::setup(int) {
  // LIGGGHTS evaluates thermo and dumps at the start of a run without having announced it.
  sampled_step_ = -1;
  if (!users_.empty()) sample();
}

bool FixContactSampler::wanted() const {
  if (requested_steps_.contains(update->ntimestep)) return true;
  if (!users_.empty() && update->ntimestep == update->laststep)
    return true;  // for what a script reads after the run
  return std::any_of(users_.begin(), users_.end(),
                     [&](Compute* c) { return c->matchstep(update->ntimestep) != 0; });
}

void FixContactSampler::post_force(int) {
  if (wanted()) sample();
  requested_steps_.erase(requested_steps_.begin(), requested_steps_.upper_bound(update->ntimestep));
}

void FixContactSampler::sample() {
  contacts_.clear();
  by_group_.clear();
  collector_->sweep(*pair_);
  volume_ = domain->xprd * domain->yprd * domain->zprd;
  box_low_ = suffuse::Vec3(domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]);
  box_high_ = suffuse::Vec3(domain->boxhi[0], domain->boxhi[1], domain->boxhi[2]);
  sampled_step_ = update->ntimestep;
  // Now, not when first read: a servo moves grains and box at the end of the step.
  for (Compute* user : users_)
    if (user->matchstep(update->ntimestep)) group_packing(user->groupbit);
}

void FixContactSampler::add_contact(int i, int j, const double* force_on_i) {
  const double* xi = atom->x[i];
  const double* xj = atom->x[j];
  const suffuse::Vec3 branch(xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]);
  const double reach = atom->radius[i] + atom->radius[j];
  if (branch.squaredNorm() >= reach * reach) return;  // forces at a distance (cohesion) are not contacts

  Contact contact;
  contact.first = i;
  contact.second = j;
  contact.branch = branch;
  contact.force = suffuse::Vec3(force_on_i[0], force_on_i[1], force_on_i[2]);
  contact.friction =
      friction_[static_cast<std::size_t>((atom->type[i] - 1) * atom->ntypes + atom->type[j] - 1)];
  contacts_.push_back(contact);
}

/// Listed by both owners; a grain that touches its own image lists both of its sides.
suffuse::micromechanics::Image FixContactSampler::image_in(const Contact& found) const {
  const int own = atom->tag[found.first], other = atom->tag[found.second];
  const double* b = found.branch.data();
  const bool positive_side = b[0] > 0 || (b[0] == 0 && (b[1] > 0 || (b[1] == 0 && b[2] > 0)));
  return {other, atom->radius[found.second], own == other ? positive_side : own > other};
}

const Packing& FixContactSampler::packing(int group_bit) {
  return group_packing(group_bit).packing;
}

const std::vector<int>& FixContactSampler::grain_index(int group_bit) {
  return group_packing(group_bit).index;
}

FixContactSampler::GroupPacking& FixContactSampler::group_packing(int group_bit) {
  if (sampled_step_ != update->ntimestep) {
    comm->forward_comm();  // at the end of a step ghosts are still at mid-step velocities
    sample();
  }
  const auto known = by_group_.find(group_bit);
  if (known != by_group_.end()) return known->second;

  GroupPacking& result = by_group_[group_bit];
  result.packing.volume = volume_;
  result.packing.box_low = box_low_;
  result.packing.box_high = box_high_;
  result.index.assign(static_cast<std::size_t>(atom->nlocal), kNotOwned);
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & group_bit) == 0) continue;
    result.index[static_cast<std::size_t>(i)] = static_cast<int>(result.packing.grains.size());
    result.packing.grains.push_back(
        {atom->tag[i], atom->radius[i], suffuse::Vec3(atom->x[i][0], atom->x[i][1], atom->x[i][2])});
  }
  for (const Contact& found : contacts_) {
    if ((atom->mask[found.first] & group_bit) == 0 || (atom->mask[found.second] & group_bit) == 0) continue;
    Contact contact = found;
    contact.first = result.index[static_cast<std::size_t>(found.first)];
    if (found.second < atom->nlocal) {
      contact.second = result.index[static_cast<std::size_t>(found.second)];
      result.packing.contacts.push_back(contact);
    } else {
      add_image_contact(result.packing, contact, image_in(found));
    }
  }
  return result;
}
