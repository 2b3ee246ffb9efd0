#include "pair_gran_vector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atom.h"
#include "domain.h"
#include "force.h"
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

}  // namespace LAMMPS_NS
