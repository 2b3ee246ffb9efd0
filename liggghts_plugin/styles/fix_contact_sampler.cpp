#include "fix_contact_sampler.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "comm.h"
#include "contact_collector.h"
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
using suffuse::micromechanics::Listing;
using suffuse::micromechanics::Packing;

namespace {
constexpr const char* kId = "suffuse_contacts";
}

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

void FixContactSampler::add_friction_user(Compute* compute) {
  friction_users_.push_back(compute);
}

void FixContactSampler::add_wall_user(Compute* compute) {
  wall_users_.push_back(compute);
}

void FixContactSampler::forget_user(LAMMPS* lmp, Compute* compute) {
  // While LIGGGHTS shuts down, computes outlive fixes.
  if (lmp->modify->find_fix(kId) < 0) return;
  auto* sampler = static_cast<FixContactSampler*>(lmp->modify->find_fix_id(kId));
  std::erase(sampler->users_, compute);
  std::erase(sampler->friction_users_, compute);
  std::erase(sampler->wall_users_, compute);
}

void FixContactSampler::request(bigint step, bool friction) {
  requested_steps_.insert(step);
  if (friction) friction_steps_.insert(step);
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
  return FixConst::POST_FORCE | FixConst::PRE_FINAL_INTEGRATE;
}

void FixContactSampler::init() {
  pair_ = &suffuse::require_granular_pair_style(lmp, "contact sampler");
  if (collector_ == nullptr) collector_ = ContactCollector::create(lmp);
  if (wall_collector_ == nullptr) wall_collector_ = WallCollector::create(lmp);
  sampled_step_ = walls_step_ = -1;
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
  if (!users_.empty()) sample(!friction_users_.empty());
  if (!wall_users_.empty()) sample_walls();
}

bool FixContactSampler::asked_by(const std::vector<Compute*>& users) const {
  if (!users.empty() && update->ntimestep == update->laststep)
    return true;  // for what a script reads after the run
  return std::any_of(users.begin(), users.end(),
                     [&](Compute* c) { return c->matchstep(update->ntimestep) != 0; });
}

void FixContactSampler::post_force(int) {
  const bigint now = update->ntimestep;
  const bool friction = friction_steps_.contains(now) || asked_by(friction_users_);
  if (friction || requested_steps_.contains(now) || asked_by(users_)) sample(friction);
  requested_steps_.erase(requested_steps_.begin(), requested_steps_.upper_bound(now));
  friction_steps_.erase(friction_steps_.begin(), friction_steps_.upper_bound(now));
}

void FixContactSampler::pre_final_integrate() {
  if (asked_by(wall_users_)) sample_walls();
}

void FixContactSampler::sample_walls() {
  walls_ = wall_collector_->sweep("contact sampler");
  walls_step_ = update->ntimestep;
  ++generation_;
}

void FixContactSampler::sample(bool friction) {
  ++generation_;
  contacts_.clear();
  by_group_.clear();
  for (const ContactCollector::Found& found : collector_->sweep(*pair_, friction)) add_contact(found);
  volume_ = domain->xprd * domain->yprd * domain->zprd;
  box_low_ = suffuse::Vec3(domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]);
  box_high_ = suffuse::Vec3(domain->boxhi[0], domain->boxhi[1], domain->boxhi[2]);
  sampled_step_ = update->ntimestep;
  has_friction_ = friction;
  // Now, not when first read: a servo moves grains and box at the end of the step.
  for (Compute* user : users_)
    if (user->matchstep(update->ntimestep)) group_packing(user->groupbit);
}

void FixContactSampler::add_contact(const ContactCollector::Found& found) {
  const double reach = atom->radius[found.i] + atom->radius[found.j];
  if (found.branch.squaredNorm() >= reach * reach)
    return;  // forces at a distance (cohesion) are not contacts
  Contact contact;
  contact.first = found.i;
  contact.second = found.j;
  contact.branch = found.branch;
  contact.force = found.force;
  contact.friction =
      friction_[static_cast<std::size_t>((atom->type[found.i] - 1) * atom->ntypes + atom->type[found.j] - 1)];
  contact.friction_limit = found.friction_limit;
  contact.spring_force = found.spring_force;
  contacts_.push_back(contact);
}

/// Listed by both owners; a grain that touches its own image lists both of its sides.
suffuse::micromechanics::Image FixContactSampler::image_in(const Contact& found) const {
  const int own = atom->tag[found.first], other = atom->tag[found.second];
  const double* b = found.branch.data();
  const bool positive_side = b[0] > 0 || (b[0] == 0 && (b[1] > 0 || (b[1] == 0 && b[2] > 0)));
  const bool stands = own == other ? positive_side : own > other;
  return {other, atom->radius[found.second], stands ? Listing::whole : Listing::elsewhere};
}

const Packing& FixContactSampler::packing(int group_bit) {
  return group_packing(group_bit).packing;
}

const Packing& FixContactSampler::packing_with_friction(int group_bit) {
  if (sampled_step_ != update->ntimestep || !has_friction_) {
    comm->forward_comm();
    sample(true);
  }
  return packing(group_bit);
}

std::vector<suffuse::micromechanics::WallContact> FixContactSampler::walls(int group_bit) {
  if (walls_step_ != update->ntimestep) sample_walls();
  const std::vector<int>& index = grain_index(group_bit);
  std::vector<suffuse::micromechanics::WallContact> result;
  for (const WallCollector::Found& found : walls_) {
    const int grain = index[static_cast<std::size_t>(found.i)];
    if (grain != kNotOwned) result.push_back({grain, found.branch, found.force});
  }
  return result;
}

const std::vector<int>& FixContactSampler::grain_index(int group_bit) {
  return group_packing(group_bit).index;
}

FixContactSampler::GroupPacking& FixContactSampler::group_packing(int group_bit) {
  if (sampled_step_ != update->ntimestep) {
    comm->forward_comm();  // at the end of a step ghosts are still at mid-step velocities
    sample(!friction_users_.empty());
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
