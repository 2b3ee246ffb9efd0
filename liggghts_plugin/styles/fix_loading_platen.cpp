#include "fix_loading_platen.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix_property_global.h"
#include "modify.h"
#include "pair_gran.h"
#include "pair_law.h"
#include "restart_record.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/coordination.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;
namespace platen = suffuse::platen;

namespace {

constexpr const char* kPlaten = "fix loading/platen";
constexpr const char* kChangeable = "stress, fixed, opening, speed";
constexpr const char* kPlatenKeywords =
    "stress, fixed, opening, speed, collect, classes, mass, damping, area, type";
/// The record in restart files: position, velocity, reference, and three values a class.
constexpr int kPlatenVersion = 3;
constexpr std::size_t kRecordFixed = 4;

FixPropertyGlobal& property(LAMMPS* lmp, const char* name, const char* kind, int columns) {
  const int types = lmp->atom->ntypes;
  auto* found = dynamic_cast<FixPropertyGlobal*>(
      lmp->modify->find_fix_property(name, "property/global", kind, types, columns, "suffuse", false));
  if (found == nullptr)
    throw_user_error({kPlaten, name, "unknown", "be defined",
                      fmt::format("write `fix ID all property/global {} {} ...`", name, kind)});
  return *found;
}

std::vector<double> read_bounds(suffuse::ArgumentReader& reader) {
  std::vector<double> bounds{reader.positive("classes (m)")};
  while (reader.next_is_number()) {
    bounds.push_back(reader.positive("classes (m)"));
    if (bounds.back() <= bounds[bounds.size() - 2])
      throw_user_error({kPlaten, "classes",
                        fmt::format("{:g} after {:g}", bounds.back(), bounds[bounds.size() - 2]), "rise",
                        "give the diameters between classes, smallest first"});
  }
  return bounds;
}

}  // namespace

FixLoadingPlaten::FixLoadingPlaten(LAMMPS* lmp_in, int narg, char** arg) : Fix(lmp_in, narg, arg) {
  suffuse::ArgumentReader reader(kPlaten, narg, arg, 3);
  suffuse::require_si_and_three_dimensions(lmp, kPlaten);
  if (atom->radius_flag == 0 || atom->rmass == nullptr)
    throw_user_error({kPlaten, "atom_style", atom->atom_style, "be spheres", "write `atom_style granular`"});
  drive_.damping_ratio = 0.5;
  const std::string side = reader.word("side (upper, lower)");
  if (side != "upper" && side != "lower") reader.unknown(side, "upper, lower");
  outward_ = side == "upper" ? 1 : -1;
  constexpr std::array<const char*, 3> planes{"xplane", "yplane", "zplane"};
  const std::string plane = reader.word("plane (xplane, yplane, zplane)");
  const auto* found = std::find(planes.begin(), planes.end(), plane);
  if (found == planes.end()) reader.unknown(plane, "xplane, yplane, zplane");
  axis_ = static_cast<int>(found - planes.begin());
  motion_.position = reference_ = reader.number("position");
  loading_given_ = false;
  while (!reader.done())
    if (!read_changeable(reader)) read_construction(reader);
  if (!loading_given_)
    throw_user_error({kPlaten, "stress", "nothing", "be given", "write `stress P` (Pa), or `fixed`"});
  check_words();
  vector_flag = 1;
  size_vector = 8;
  array_flag = 1;
  size_array_rows = static_cast<int>(passed_.classes());
  size_array_cols = 3;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = extvector = extarray = 0;
  restart_global = 1;
}

/// Words that `fix_modify` takes too.
bool FixLoadingPlaten::read_changeable(suffuse::ArgumentReader& reader) {
  const bool fixed = reader.keyword("fixed");
  if (fixed || reader.keyword("stress")) {
    if (loading_given_)
      throw_user_error(
          {reader.who(), "stress", "given together with fixed", "be given, or fixed", "drop one of the two"});
    loading_given_ = true;
    stress_ = fixed ? std::nullopt : std::optional(reader.positive("stress"));
  } else if (reader.keyword("opening"))
    opening_ = reader.number("opening");
  else if (reader.keyword("speed"))
    given_speed_ = reader.positive("speed");
  else
    return false;
  if (opening_ < 0)
    throw_user_error({kPlaten, "opening", fmt::format("{:g}", opening_), "be >= 0",
                      "give the diameter (m) below which grains pass; 0 holds all"});
  return true;
}

void FixLoadingPlaten::read_construction(suffuse::ArgumentReader& reader) {
  if (reader.keyword("collect"))
    collect_ = reader.positive("collect");
  else if (reader.keyword("classes"))
    passed_ = platen::SizeTally(read_bounds(reader));
  else if (reader.keyword("mass"))
    given_mass_ = reader.positive("mass");
  else if (reader.keyword("damping"))
    drive_.damping_ratio = reader.positive("damping");
  else if (reader.keyword("area"))
    given_area_ = reader.positive("area");
  else if (reader.keyword("type"))
    type_ = static_cast<int>(std::min<std::int64_t>(reader.positive_integer("type"), 1000000));
  else
    reader.unknown(reader.word("keyword"), kPlatenKeywords);
}

void FixLoadingPlaten::check_words() const {
  if (type_ > atom->ntypes)
    throw_user_error({kPlaten, "type", std::to_string(type_),
                      fmt::format("be one of the {} types", atom->ntypes),
                      "name the type whose material the platen has"});
  constexpr int fixed_face = 1;  // LIGGGHTS: 0 periodic, 1 fixed, 2 and 3 shrink-wrapped
  for (const int face : domain->boundary[axis_])
    if (face != fixed_face)
      throw_user_error({kPlaten, "boundary",
                        fmt::format("{} along {}", face == 0 ? "periodic" : "shrink-wrapped", "xyz"[axis_]),
                        "be fixed across a platen", "write `boundary` with f for this axis"});
  if (motion_.position < domain->boxlo[axis_] || motion_.position > domain->boxhi[axis_])
    throw_user_error(
        {kPlaten, "position", fmt::format("{:g}", motion_.position), "lie in the box",
         fmt::format("give one from {:g} to {:g} m", domain->boxlo[axis_], domain->boxhi[axis_])});
  if (collect_ == 0 && passed_.classes() > 1)
    throw_user_error({kPlaten, "classes", "without collect", "go with `collect L`",
                      "add how far (m) beyond the platen grains are taken out of the box"});
}

int FixLoadingPlaten::setmask() {
  return FixConst::INITIAL_INTEGRATE | FixConst::POST_FORCE | FixConst::PRE_EXCHANGE;
}

void FixLoadingPlaten::post_create() {
  suffuse::act_before_constraints(lmp, this);
}

void FixLoadingPlaten::init() {
  suffuse::require_single_spheres(lmp, kPlaten);
  if (const auto law = suffuse::PairLaw::of(lmp, kPlaten); law.kind() != suffuse::PairLaw::Kind::hertz)
    throw_user_error({kPlaten, "pair_style gran", law.name(),
                      "be `model hertz`: the platen's contacts are Hertz's",
                      "write `pair_style gran model hertz tangential history`"});
  connect_materials();
  take_drive();
}

void FixLoadingPlaten::connect_materials() {
  auto& modulus = property(lmp, "youngsModulus", "peratomtype", 0);
  auto& ratio = property(lmp, "poissonsRatio", "peratomtype", 0);
  auto& restitution = property(lmp, "coefficientRestitution", "peratomtypepair", atom->ntypes);
  materials_.clear();
  for (int type = 0; type < atom->ntypes; ++type)
    materials_.push_back(
        {platen::effective_modulus(modulus.compute_vector(type), ratio.compute_vector(type),
                                   modulus.compute_vector(type_ - 1), ratio.compute_vector(type_ - 1)),
         platen::damping_factor(restitution.compute_array(type, type_ - 1))});
}

double FixLoadingPlaten::area() const {
  if (given_area_ > 0) return given_area_;
  double product = 1;
  for (int side = 0; side < 3; ++side)
    if (side != axis_) product *= domain->boxhi[side] - domain->boxlo[side];
  return product;
}

/// Mass: a tenth of the sample's, so that the platen follows its grains and a step that these bear, it bears.
/// Speed: 0.02 √(P/ρ), an inertial number of 0.02 d/H of a sample of height H.
void FixLoadingPlaten::take_drive() {
  if (!stress_) {
    motion_.velocity = 0;
    return;
  }
  const auto grains = suffuse::grain_statistics(lmp, groupbit);
  if (grains.count == 0 && (given_mass_ == 0 || given_speed_ == 0))
    throw_user_error({kPlaten, "group", "without grains",
                      "have grains, which the platen's mass and speed follow from",
                      "insert them before the first run, or give `mass M` and `speed V`"});
  constexpr double share = 0.1, speed = 0.02;
  drive_.load = *stress_ * area();
  drive_.mass = share * grains.solid_volume * grains.mean_density;
  // A run that goes on has the mass that the run began with, which grains may have left since.
  if (restored_mass_ > 0) drive_.mass = restored_mass_;
  if (given_mass_ > 0) drive_.mass = given_mass_;
  drive_.most_speed = given_speed_ > 0 ? given_speed_ : speed * std::sqrt(*stress_ / grains.mean_density);
}

void FixLoadingPlaten::setup(int) {
  restored_mass_ = 0;  // not in init, which a command between the line and the run may call as well
  press();
}

void FixLoadingPlaten::initial_integrate(int) {
  if (stress_) platen::advance(motion_, drive_, reaction_, outward_, update->dt);
}

void FixLoadingPlaten::post_force(int) {
  press();
}

/// Forces of the contacts of now, and their sums over all ranks.
void FixLoadingPlaten::press() {
  std::array<double, 3> sums{};  // force, stiffness, contacts
  for (int i = 0; i < atom->nlocal; ++i) {
    const double radius = atom->radius[i];
    if ((atom->mask[i] & groupbit) == 0 || !holds(radius)) continue;
    const double depth = beyond(atom->x[i][axis_]);
    if (depth + radius <= 0 || depth > 0) continue;  // a grain whose centre is beyond has passed
    const double approach = outward_ * atom->v[i][axis_] - motion_.velocity;
    const auto& material = materials_[static_cast<std::size_t>(atom->type[i] - 1)];
    const platen::Reaction own = platen::reaction(material, radius, atom->rmass[i], depth + radius, approach);
    atom->f[i][axis_] -= outward_ * own.force;
    sums[0] += own.force;
    sums[1] += own.stiffness;
    sums[2] += 1;
  }
  suffuse::sum_over_ranks(lmp, sums);
  reaction_ = {sums[0], sums[1]};
  contacts_ = sums[2];
  if (stress_ && platen::stiffness_of_step(drive_, reaction_, update->dt) > 1)
    throw_user_error({kPlaten, "mass", fmt::format("{:g} kg", drive_.mass),
                      fmt::format("be above {:.3g} kg for this step and these contacts",
                                  reaction_.stiffness * update->dt * update->dt),
                      "give `mass M`, or a smaller timestep"});
}

void FixLoadingPlaten::pre_exchange() {
  if (collect_ == 0) return;
  std::vector<double> sums(2 * passed_.classes(), 0.);
  const double outside = outward_ > 0 ? 2 * domain->boxhi[axis_] - domain->boxlo[axis_]
                                      : 2 * domain->boxlo[axis_] - domain->boxhi[axis_];
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0 || beyond(atom->x[i][axis_]) <= collect_) continue;
    const double radius = atom->radius[i];
    const std::size_t at = 2 * passed_.class_of(2 * radius);
    sums[at] += 1;
    sums[at + 1] +=
        atom->density[i] * suffuse::micromechanics::sphere_volume(radius);  // true, whatever scales rmass
    atom->x[i][axis_] = outside;
  }
  suffuse::sum_over_ranks(lmp, sums);
  for (std::size_t k = 0; k < passed_.classes(); ++k) {
    passed_.row(k).grains += sums[2 * k];
    passed_.row(k).mass += sums[2 * k + 1];
    atom->natoms -= static_cast<bigint>(std::llround(sums[2 * k]));
  }
}

int FixLoadingPlaten::modify_param(int narg, char** arg) {
  suffuse::ArgumentReader reader("fix_modify of a loading/platen", narg, arg, 0);
  loading_given_ = false;
  while (!reader.done()) {
    if (reader.keyword("settlement")) {
      if (!reader.accept("zero")) reader.unknown(reader.word("settlement"), "zero");
      reference_ = motion_.position;
    } else if (!read_changeable(reader))
      reader.unknown(reader.word("keyword"), std::string(kChangeable) + ", settlement zero");
  }
  return narg;
}

/// Settlement, m.
double FixLoadingPlaten::compute_scalar() {
  return compute_vector(1);
}

/// Position (m), settlement (m), speed into the sample (m/s), stress of the contacts and set stress (Pa; 0 of
/// a fixed one), contacts, grains that have passed and their mass (kg).
double FixLoadingPlaten::compute_vector(int n) {
  const auto total = passed_.total();
  const double values[] = {motion_.position,    -outward_ * (motion_.position - reference_),
                           -motion_.velocity,   reaction_.force / area(),
                           stress_.value_or(0), contacts_,
                           total.grains,        total.mass};
  return values[n];
}

/// A row a class: upper bound of its diameters (m; 0 of the last class, which has none), grains that have
/// passed, their mass (kg).
double FixLoadingPlaten::compute_array(int row, int column) {
  const auto k = static_cast<std::size_t>(row);
  if (column == 0) return k < passed_.bounds().size() ? passed_.bounds()[k] : 0;
  return column == 1 ? passed_.row(k).grains : passed_.row(k).mass;
}

void FixLoadingPlaten::write_restart(FILE* file) {
  if (comm->me != 0) return;
  std::vector<double> values{motion_.position, motion_.velocity, reference_, drive_.mass};
  for (std::size_t k = 0; k < passed_.classes(); ++k)
    values.insert(values.end(),
                  {compute_array(static_cast<int>(k), 0), passed_.row(k).grains, passed_.row(k).mass});
  suffuse::write_record(file, {kPlatenVersion, "", values});
}

/// The state goes on from the file; stress, opening and the rest are those of the script's line.
void FixLoadingPlaten::restart(char* buffer) {
  const std::vector<double> values =
      suffuse::read_record(buffer, kPlatenVersion, kRecordFixed + 3 * passed_.classes(), kPlaten).values;
  bool same = true;
  for (std::size_t k = 0; same && k < passed_.classes(); ++k)
    same = values[kRecordFixed + 3 * k] == compute_array(static_cast<int>(k), 0);
  if (!same)
    throw_user_error({kPlaten, "classes", "other ones than in the restart file", "be the same",
                      "take those of the run before"});
  motion_ = {values[0], values[1]};
  reference_ = values[2];
  restored_mass_ = values[3];
  for (std::size_t k = 0; k < passed_.classes(); ++k)
    passed_.row(k) = {values[kRecordFixed + 3 * k + 1], values[kRecordFixed + 3 * k + 2]};
}
