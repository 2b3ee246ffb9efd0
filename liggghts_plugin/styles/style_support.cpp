#include "style_support.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "fix_property_global.h"
#include "force.h"
#include "group.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair_gran.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/sphere.h"
#include "update.h"

using LAMMPS_NS::LAMMPS;

namespace suffuse {
namespace {

bool parse_number(const char* text, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && std::isfinite(value);
}

}  // namespace

ArgumentReader::ArgumentReader(std::string who, int narg, char** arg, int first)
    : who_(std::move(who)), narg_(narg), arg_(arg), next_(first) {}

std::string ArgumentReader::word(std::string_view purpose) {
  if (done())
    throw_user_error({who_, std::string(purpose), "nothing (the line ends)", "be given",
                      "add it, see the command reference"});
  return arg_[next_++];
}

bool ArgumentReader::accept(std::string_view expected) {
  if (done() || expected != arg_[next_]) return false;
  ++next_;
  return true;
}

void ArgumentReader::take_once(const std::string& word) {
  if (!taken_.insert(word).second)
    throw_user_error({who_, word, "given twice", "be given once", "drop one of the two"});
}

bool ArgumentReader::keyword(std::string_view expected) {
  if (!accept(expected)) return false;
  take_once(std::string(expected));
  return true;
}

std::string ArgumentReader::keyword() {
  const std::string given = word("keyword");
  take_once(given);
  return given;
}

bool ArgumentReader::next_is_number() const {
  double value = 0;
  return !done() && parse_number(arg_[next_], value);
}

double ArgumentReader::number(std::string_view what) {
  const std::string text = word(what);
  double value = 0;
  if (!parse_number(text.c_str(), value))
    throw_user_error({who_, std::string(what), text, "be a number", "write it in SI units, e.g. 200e3"});
  return value;
}

double ArgumentReader::positive(std::string_view what) {
  const double value = number(what);
  if (!(value > 0))
    throw_user_error({who_, std::string(what), arg_[next_ - 1], "be > 0", "give its magnitude in SI units"});
  return value;
}

std::int64_t ArgumentReader::positive_integer(std::string_view what) {
  const double value = number(what);
  if (!(value >= 1) || value != std::floor(value) || value > 9e15)
    throw_user_error({who_, std::string(what), arg_[next_ - 1], "be a whole number >= 1", ""});
  return static_cast<std::int64_t>(value);
}

void ArgumentReader::unknown(std::string_view given, std::string_view known) const {
  throw_user_error({who_, "keyword", std::string(given), "be one of: " + std::string(known), ""});
}

void tell(LAMMPS* lmp, std::string_view text) {
  if (lmp->comm->me != 0) return;
  for (std::FILE* to : {lmp->screen, lmp->logfile}) {
    if (to == nullptr) continue;
    fmt::print(to, "{}", text);
    std::fflush(to);
  }
}

bool constrains_forces(std::string_view style) {
  constexpr std::array<std::string_view, 6> styles{"freeze",     "setforce",  "aveforce",
                                                   "planeforce", "lineforce", "enforce2d"};
  return std::find(styles.begin(), styles.end(), style) != styles.end();
}

void act_before_constraints(LAMMPS* lmp, const LAMMPS_NS::Fix* fix) {
  LAMMPS_NS::Modify* modify = lmp->modify;
  int first = 0, from = 0;
  while (first < modify->nfix && !constrains_forces(modify->fix[first]->style)) ++first;
  while (from < modify->nfix && modify->fix[from] != fix) ++from;
  if (first >= from) return;
  std::rotate(modify->fix + first, modify->fix + from, modify->fix + from + 1);
  std::rotate(modify->fmask + first, modify->fmask + from, modify->fmask + from + 1);
  // Atom knows the fixes that keep values of grains by their places, and restart files have them in the order
  // of these.
  LAMMPS_NS::Atom* atom = lmp->atom;
  const auto renumber = [&](int* places, int count) {
    for (int n = 0; n < count; ++n)
      if (places[n] == from)
        places[n] = first;
      else if (places[n] >= first && places[n] < from)
        ++places[n];
    std::sort(places, places + count);
  };
  renumber(atom->extra_grow, atom->nextra_grow);
  renumber(atom->extra_restart, atom->nextra_restart);
  renumber(atom->extra_border, atom->nextra_border);
}

void require_grains_in_group(LAMMPS* lmp, std::string_view who, int igroup) {
  if (lmp->group->count(igroup) > 0) return;
  throw_user_error({std::string(who), "group", lmp->group->names[igroup], "contain grains",
                    "insert the grains first, or name another group"});
}

LAMMPS_NS::PairGran& require_granular_pair_style(LAMMPS* lmp, std::string_view who) {
  auto* pair = lmp->force->pair == nullptr ? nullptr : lmp->force->pair_match("gran", 0);
  auto* granular = dynamic_cast<LAMMPS_NS::PairGran*>(pair);
  if (granular == nullptr)
    throw_user_error({std::string(who), "pair style",
                      lmp->force->pair_style ? lmp->force->pair_style : "none", "be a granular one",
                      "write `pair_style gran model hertz tangential history` and `pair_coeff * *` before"});
  return *granular;
}

void init_keeping_restart_records(LAMMPS* lmp) {
  lmp->update->init();
  lmp->force->init();
  lmp->domain->init();
  LAMMPS_NS::Atom* atom = lmp->atom;
  LAMMPS_NS::Modify* modify = lmp->modify;
  const int of_grains = std::exchange(atom->nextra_store, 0);
  double** const extra = atom->extra;
  atom->init();
  const int fixes = std::exchange(modify->nfix_restart_global, 0),
            fixes_of_grains = std::exchange(modify->nfix_restart_peratom, 0);
  modify->init();
  atom->nextra_store = of_grains;
  atom->extra = extra;
  modify->nfix_restart_global = fixes;
  modify->nfix_restart_peratom = fixes_of_grains;
  lmp->group->init();
  lmp->neighbor->init();
  lmp->comm->init();
  lmp->output->init();
}

void require_periodic_box(LAMMPS* lmp, std::string_view who) {
  if (lmp->domain->box_exist == 0)
    throw_user_error(
        {std::string(who), "simulation box", "none", "exist", "write `create_box` or `read_restart` before"});
  if (lmp->domain->nonperiodic != 0)
    throw_user_error(
        {std::string(who), "boundary", "not periodic on all faces", "be periodic", "write `boundary p p p`"});
  if (lmp->domain->triclinic != 0)
    throw_user_error({std::string(who), "box", "triclinic", "be orthogonal", "use a `region ... block`"});
}

void require_si_and_three_dimensions(LAMMPS* lmp, std::string_view who) {
  if (std::strcmp(lmp->update->unit_style, "si") != 0)
    throw_user_error(
        {std::string(who), "units", lmp->update->unit_style, "be si", "write `units si` and SI values"});
  if (lmp->domain->dimension != 3)
    throw_user_error({std::string(who), "dimension", std::to_string(lmp->domain->dimension), "be 3",
                      "drop the line `dimension`: grains are spheres in space"});
}

void require_single_spheres(LAMMPS* lmp, std::string_view who) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::strncmp(lmp->modify->fix[i]->style, "multisphere", 11) == 0)
      throw_user_error({std::string(who), "fix", lmp->modify->fix[i]->style,
                        "not be defined: spheres of a clump would count as grains of their own",
                        "use single spheres (`fix nve/sphere`), or leave this style out"});
}

bool grains_have_friction(LAMMPS* lmp) {
  const int types = lmp->atom->ntypes;
  auto* friction = dynamic_cast<LAMMPS_NS::FixPropertyGlobal*>(lmp->modify->find_fix_property(
      "coefficientFriction", "property/global", "peratomtypepair", types, types, "suffuse", false));
  if (friction == nullptr) return false;
  for (int i = 0; i < types; ++i)
    for (int j = 0; j < types; ++j)
      if (friction->compute_array(i, j) > 0) return true;
  return false;
}

void sum_over_ranks(LAMMPS* lmp, std::span<double> values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                lmp->world);
}

GrainStatistics grain_statistics(LAMMPS* lmp, int groupbit) {
  const auto* atom = lmp->atom;
  std::array<double, 5> sums{};  // count, volume, mass, diameters, mass times diameter
  std::array<double, 2> extremes{std::numeric_limits<double>::lowest(),
                                 std::numeric_limits<double>::lowest()};
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    const double radius = atom->radius[i];
    const double volume = micromechanics::sphere_volume(radius);
    const double mass = atom->density[i] * volume;
    sums[0] += 1;
    sums[1] += volume;
    sums[2] += mass;
    sums[3] += 2 * radius;
    sums[4] += mass * 2 * radius;
    extremes[0] = std::max(extremes[0], -radius);
    extremes[1] = std::max(extremes[1], radius);
  }
  sum_over_ranks(lmp, sums);
  MPI_Allreduce(MPI_IN_PLACE, extremes.data(), 2, MPI_DOUBLE, MPI_MAX, lmp->world);
  GrainStatistics statistics;
  statistics.count = static_cast<std::int64_t>(sums[0]);
  if (statistics.count == 0) return statistics;
  statistics.solid_volume = sums[1];
  statistics.mean_density = sums[2] / sums[1];
  statistics.smallest_radius = -extremes[0];
  statistics.largest_radius = extremes[1];
  statistics.number_mean_diameter = sums[3] / sums[0];
  statistics.mass_mean_diameter = sums[4] / sums[2];
  return statistics;
}

}  // namespace suffuse
