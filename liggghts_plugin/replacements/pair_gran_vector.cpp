#include "pair_gran_vector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atom.h"
#include "domain.h"
#include "force.h"
#include "grains/grain_motion.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor_by_size.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"
#include "update.h"

namespace LAMMPS_NS {

using suffuse::grains::ContactNote;
using suffuse::grains::NormalLaw;
using suffuse::grains::PassSettings;
using suffuse::grains::RollingLaw;
using suffuse::grains::TangentialLaw;

namespace {
constexpr const char* kWho = "pair_style gran";
constexpr double kNever = -1;  // w of a spring whose pair has not touched
constexpr std::uint32_t kNoTwin = ~0u;
/// A grain of `fix freeze` has no mass of its own in a contact (LIGGGHTS takes the partner's for both); where
/// both are frozen their forces are not used, but stay numbers.
constexpr double kFrozenInverseMass = 1e-30;

bool one_of(const std::string& value, std::initializer_list<const char*> known) {
  return std::any_of(known.begin(), known.end(), [&](const char* k) { return value == k; });
}

bool choice(const std::string& keyword, const std::string& value, const char* yes, const char* no) {
  if (value == yes) return true;
  if (value == no) return false;
  suffuse::throw_user_error({kWho, keyword, value, fmt::format("be {} or {}", yes, no), ""});
}
}  // namespace

PairGranVector::PairGranVector(LAMMPS* lmp_in)
    : PairGranProxy(lmp_in), instruction_set_(suffuse::default_instruction_set()) {}

void PairGranVector::settings(int narg, char** arg) {
  std::vector<char*> stock;
  foreign_option_.clear();
  law_ = {};
  tangential_damping_ = true;
  two_sevenths_ = false;
  for (int k = 0; k < narg; ++k) {
    if (k + 1 < narg && read_own_keyword(arg[k], arg[k + 1])) {
      ++k;
      continue;
    }
    stock.push_back(arg[k]);
    if (k + 1 == narg) break;  // LIGGGHTS says what is wrong with an odd number of words
    read_option(arg[k], arg[k + 1]);
    stock.push_back(arg[++k]);
  }
  PairGranProxy::settings(static_cast<int>(stock.size()), stock.data());
  options_known_ = true;
}

bool PairGranVector::read_own_keyword(const std::string& keyword, const std::string& value) {
  if (keyword == "loop") {
    vector_wanted_ = choice(keyword, value, "vector", "stock");
  } else if (keyword == "lost_springs") {
    drop_lost_springs_ = choice(keyword, value, "drop", "keep");
  } else if (keyword == "normal_at") {
    half_step_normal_ = choice(keyword, value, "half_step", "full_step");
  } else if (keyword == "compare") {
    char* end = nullptr;
    compare_every_ = std::strtoll(value.c_str(), &end, 10);
    if (value.empty() || *end != '\0' || compare_every_ < 1)
      suffuse::throw_user_error({kWho, keyword, value, "be a number of steps >= 1", ""});
  } else {
    return false;
  }
  return true;
}

void PairGranVector::read_option(const std::string& keyword, const std::string& value) {
  if (one_of(keyword, {"model", "tangential", "cohesion", "rolling_friction", "surface"})) return;
  const bool on = value == "on";
  if (keyword == "tangential_damping") {
    tangential_damping_ = on;
  } else if (keyword == "limitForce") {
    law_.limit_force = on;
  } else if (keyword == "ktToKnUser") {
    two_sevenths_ = on;
  } else if (keyword == "absolute_damping") {
    law_.absolute_damping = on;
  } else if (keyword == "torsionTorque") {
    law_.torsion = on;
  } else if (on) {
    foreign_option_ = keyword;
  }
}

std::string PairGranVector::why_stock() {
  const auto model = [this](const char* kind, const char* name) { return contact_match(kind, name); };
  if (!vector_wanted_) return "asked for by `loop stock`";
  if (!options_known_)
    return "a restart file does not hold the model's options; write `pair_style gran ...` again";
  if (!foreign_option_.empty()) return fmt::format("option {}", foreign_option_);
  if (!model("cohesion", "off")) return "cohesion";
  if (!model("surface", "default")) return "surface model";
  if (!model("normal", "hertz") && !model("normal", "hooke") && !model("normal", "hooke/stiffness"))
    return "normal model";
  if (!model("tangential", "history") && !model("tangential", "no_history") && !model("tangential", "off"))
    return "tangential model";
  if (!model("rolling_friction", "off") && !model("rolling_friction", "cdt")) return "rolling friction model";
  if (dnum() != (model("tangential", "history") ? 3 : 0)) return "contact history of another model or fix";
  if (force->pair != this) return "pair style hybrid";
  if (fix_rigid != nullptr) return "rigid bodies";
  if (force->newton_pair != 0) return "newton on";
  if (atom->rmass == nullptr || atom->superquadric_flag != 0 || atom->shapetype_flag != 0)
    return "grains are no spheres";
  if (fix_sum_normal_force_ != nullptr) return "sum of normal forces";
  if (force->nktv2p != 1) return "units";
  if (force->cg_active()) return "coarse graining";
  for (const char* style :
       {"insert/stream/predefined", "relax", "heat/gran/conduction", "multicontact/halfspace"})
    if (modify->n_fixes_style(style) > 0) return fmt::format("fix {}", style);
  for (int k = 0; k < modify->ncompute; ++k)
    if (std::string(modify->compute[k]->style) == "contact/atom/gran") return "compute contact/atom/gran";
  if (!drop_lost_springs_ && neighbor->contactDistanceFactor > 1)
    return "`lost_springs keep` with a contact distance";
  return "";
}

void PairGranVector::tell_which_loop(const std::string& reason) {
  std::string text;
  if (reason.empty())
    text = fmt::format("pair gran: contacts by the vectorised loop ({})", name_of(instruction_set_));
  else
    text = fmt::format("pair gran: contacts by LIGGGHTS's own loop ({})", reason);
  if (text == told_) return;
  told_ = text;
  suffuse::tell(lmp, text + "\n");
}

void PairGranVector::init_granular() {
  PairGranProxy::init_granular();
  // Whatever was in our own order is in LIGGGHTS's lists, or these are made anew before they are read.
  springs_to_lists();
  lists_are_newer_ = true;
  const std::string reason = why_stock();
  ours_ = reason.empty();
  tell_which_loop(reason);
  if (ours_) connect_properties();
}

void PairGranVector::connect_properties() {
  if (contact_match("normal", "hertz")) law_.normal = NormalLaw::hertz;
  if (contact_match("normal", "hooke")) law_.normal = NormalLaw::hooke;
  if (contact_match("normal", "hooke/stiffness")) law_.normal = NormalLaw::hooke_stiffness;
  if (contact_match("tangential", "off")) law_.tangential = TangentialLaw::off;
  if (contact_match("tangential", "no_history")) law_.tangential = TangentialLaw::no_history;
  if (contact_match("tangential", "history")) law_.tangential = TangentialLaw::history;
  law_.rolling = contact_match("rolling_friction", "cdt") ? RollingLaw::cdt : RollingLaw::off;

  law_.materials = force->registry.max_type();  // LIGGGHTS's tables end with the highest type that has grains

  const auto connect = [this](const char* name, double**& target) {
    force->registry.connect(name, target, kWho);
  };
  properties_ = {};
  if (law_.normal == NormalLaw::hooke_stiffness) {
    connect("k_n", properties_.effective_modulus);
    connect("k_t", properties_.effective_shear_modulus);
    connect(law_.absolute_damping ? "gamman_abs" : "gamman", properties_.damping);
    connect(law_.absolute_damping ? "gammat_abs" : "gammat", properties_.tangential_damping);
  } else {
    connect("Yeff", properties_.effective_modulus);
    connect("Geff", properties_.effective_shear_modulus);
    connect(law_.normal == NormalLaw::hertz ? "betaeff" : "coeffRestLog", properties_.damping);
    if (law_.normal == NormalLaw::hooke)
      force->registry.connect("charVel", law_.characteristic_velocity, kWho);
  }
  if (law_.tangential != TangentialLaw::off) connect("coeffFrict", properties_.friction);
  if (law_.rolling == RollingLaw::cdt) connect("coeffRollFrict", properties_.rolling_friction);
}

void PairGranVector::take_coefficients() {
  const int types = law_.materials;
  coefficients_.resize(static_cast<std::size_t>(types) * static_cast<std::size_t>(types));
  for (int p = 1; p <= types; ++p) {
    for (int q = 1; q <= types; ++q) {
      auto& c = coefficients_[static_cast<std::size_t>((p - 1) * types + q - 1)];
      c.normal_stiffness = properties_.effective_modulus[p][q];
      c.tangential_stiffness = properties_.effective_shear_modulus[p][q];
      if (law_.normal == NormalLaw::hertz) {
        c.normal_damping = c.tangential_damping = -2 * std::sqrt(5. / 6) * properties_.damping[p][q];
      } else if (law_.normal == NormalLaw::hooke) {
        const double log = properties_.damping[p][q];
        c.normal_damping = c.tangential_damping =
            std::sqrt(4 * log * log / (log * log + std::numbers::pi * std::numbers::pi));
        c.tangential_stiffness = two_sevenths_ ? 0.285714286 : 1;
      } else {
        c.normal_damping = properties_.damping[p][q];
        c.tangential_damping = properties_.tangential_damping[p][q];
      }
      if (!tangential_damping_) c.tangential_damping = 0;
      c.friction = properties_.friction != nullptr ? properties_.friction[p][q] : 0;
      c.rolling_friction = properties_.rolling_friction != nullptr ? properties_.rolling_friction[p][q] : 0;
    }
  }
  law_.coefficients = coefficients_.data();
}

bool PairGranVector::can_do(int eflag, int addflag) const {
  if (!ours_ || eflag / 2 != 0) return false;
  if (store_contact_forces_ || store_contact_forces_stress_ || store_multicontact_data_) return false;
  return addflag != 0 ? cpl_ != nullptr && computeflag_ == 0 : computeflag_ != 0;
}

void PairGranVector::compute_force(int eflag, int vflag, int addflag) {
  if (!can_do(eflag, addflag)) {
    springs_to_lists();
    PairGranProxy::compute_force(eflag, vflag, addflag);
    if (computeflag_ != 0 && shearupdate_ != 0) lists_are_newer_ = true;
    return;
  }
  const bigint generation = static_cast<NeighborBySize*>(neighbor)->generation();
  if (generation != seen_generation_ || lists_are_newer_) {
    take_lists();
    seen_generation_ = generation;
  }
  take_coefficients();
  if (addflag != 0) {
    sample_pass();
    return;
  }
  if (compare_every_ > 0 && update->ntimestep % compare_every_ == 0) {
    compare_with_stock(eflag, vflag);
    return;
  }
  if (eflag != 0 || vflag != 0)
    ev_setup(eflag, vflag);
  else
    evflag = vflag_fdotr = 0;
  force_pass(vflag);
}

// ---- what is made of new lists

void PairGranVector::take_lists() {
  const bool springy = law_.tangential == TangentialLaw::history;
  std::size_t total = 0;
  for (int ii = 0; ii < list->inum; ++ii) total += static_cast<std::size_t>(list->numneigh[list->ilist[ii]]);
  first_.resize(total);
  second_.resize(total);
  springs_.assign(springy ? total : 1, {0, 0, 0, kNever});
  std::size_t k = 0;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    const int* flags = springy ? listgranhistory->firstneigh[i] : nullptr;
    const double* values = springy ? listgranhistory->firstdouble[i] : nullptr;
    for (int jj = 0; jj < list->numneigh[i]; ++jj, ++k) {
      first_[k] = i;
      second_[k] = list->firstneigh[i][jj] & NEIGHMASK;
      if (springy && flags[jj] != 0)
        springs_[k] = {values[3 * jj], values[3 * jj + 1], values[3 * jj + 2], pass_number_};
    }
  }
  find_owners();
  find_twins();
  choose_active();
  lists_are_newer_ = springs_are_newer_ = false;
}

void PairGranVector::find_owners() {
  const int owned = atom->nlocal, all = owned + atom->nghost;
  // Under `fix deform ... remap v` an image has another velocity than its original.
  const bool can_map = atom->map_style != 0 && domain->deform_vremap == 0;
  owner_.resize(static_cast<std::size_t>(all));
  for (int i = 0; i < all; ++i) {
    int& owner = owner_[static_cast<std::size_t>(i)];
    owner = i;
    if (i < owned) continue;
    const int original = can_map ? atom->map(atom->tag[i]) : -1;
    if (original >= 0 && original < owned) owner = original;
  }
  immovable_.resize(static_cast<std::size_t>(all));
  for (int i = 0; i < all; ++i)
    immovable_[static_cast<std::size_t>(i)] =
        (atom->mask[i] & freeze_group_bit_) != 0 ? kFrozenInverseMass : 1;
}

/// A pair across a periodic face of a rank's own stands twice in the lists, as (i, image of o) and (o, image
/// of i): found by its grains and the number of box lengths between the two.
void PairGranVector::find_twins() {
  struct Image {
    std::int64_t grains;
    int shift;
    std::uint32_t pair;
  };
  std::vector<Image> images;
  twin_.assign(first_.size(), kNoTwin);
  const int owned = atom->nlocal;
  for (std::size_t k = 0; k < first_.size(); ++k) {
    const int i = first_[k], j = second_[k], o = owner_[static_cast<std::size_t>(j)];
    if (j < owned || o == j || o == i) continue;
    int shift = 0;
    for (int d = 0; d < 3; ++d) {
      const auto boxes = static_cast<int>(std::lround((atom->x[j][d] - atom->x[o][d]) / domain->prd[d]));
      shift = shift * 16 + 8 + (i < o ? boxes : -boxes);
    }
    images.push_back({static_cast<std::int64_t>(std::min(i, o)) << 32 | std::max(i, o), shift,
                      static_cast<std::uint32_t>(k)});
  }
  std::sort(images.begin(), images.end(), [](const Image& a, const Image& b) {
    return a.grains != b.grains ? a.grains < b.grains
           : a.shift != b.shift ? a.shift < b.shift
                                : a.pair < b.pair;
  });
  for (std::size_t k = 0; k + 1 < images.size(); ++k) {
    const Image &a = images[k], &b = images[k + 1];
    if (a.grains != b.grains || a.shift != b.shift || first_[a.pair] == first_[b.pair]) continue;
    twin_[a.pair] = b.pair;
    twin_[b.pair] = a.pair;
    ++k;
  }
}

void PairGranVector::choose_active() {
  const int owned = atom->nlocal, nobody = owned;
  loads_.assign(static_cast<std::size_t>(owned) + 1, {});
  images_.clear();
  foreign_.clear();
  std::vector<bool> seen(static_cast<std::size_t>(atom->nghost), false);
  active_first_.clear();
  active_second_.clear();
  active_motion_.clear();
  active_receiver_.clear();
  active_spring_.clear();
  active_pair_.clear();
  const bool springy = law_.tangential == TangentialLaw::history;
  for (std::size_t k = 0; k < first_.size(); ++k) {
    const bool has_twin = twin_[k] != kNoTwin;
    if (has_twin && twin_[k] < k) continue;
    const int j = second_[k], owner = owner_[static_cast<std::size_t>(j)];
    if (j >= owned && !seen[static_cast<std::size_t>(j - owned)]) {
      seen[static_cast<std::size_t>(j - owned)] = true;
      images_.push_back(static_cast<std::size_t>(j));
      if (owner == j) foreign_.push_back(static_cast<std::size_t>(j));
    }
    active_first_.push_back(first_[k]);
    active_second_.push_back(j);
    active_motion_.push_back(owner);
    // Without a twin the other side of the pair is in another rank's list.
    active_receiver_.push_back(j < owned ? j : has_twin ? owner : nobody);
    active_spring_.push_back(springy ? static_cast<std::uint32_t>(k) : 0);
    active_pair_.push_back(static_cast<std::uint32_t>(k));
  }
}

void PairGranVector::springs_to_lists() {
  if (!springs_are_newer_) return;
  springs_are_newer_ = false;
  std::size_t k = 0;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    int* flags = listgranhistory->firstneigh[i];
    double* values = listgranhistory->firstdouble[i];
    for (int jj = 0; jj < list->numneigh[i]; ++jj, ++k) {
      const bool second = twin_[k] != kNoTwin && twin_[k] < k;
      const auto& spring = springs_[second ? twin_[k] : k];
      const bool held = spring.w >= (drop_lost_springs_ ? pass_number_ : 0);
      const double sign = !held ? 0 : second ? -1 : 1;
      flags[jj] = held ? 1 : 0;
      values[3 * jj] = sign * spring.x;
      values[3 * jj + 1] = sign * spring.y;
      values[3 * jj + 2] = sign * spring.z;
    }
  }
}

// ---- passes

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
  std::vector<suffuse::grains::Quad> springs(springy ? total : 1);
  for (k = 0; k < values.size(); ++k) springs[k] = {values[k][0], values[k][1], values[k][2], pass_number_};

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
  return {active_first_.size(),  active_first_.data(),    active_second_.data(),
          active_motion_.data(), active_receiver_.data(), active_spring_.data()};
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
