#include "pair_law.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "atom.h"
#include "comm.h"
#include "fix_property_global.h"
#include "lammps.h"
#include "modify.h"
#include "pair_gran.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/sphere.h"

using namespace LAMMPS_NS;

namespace suffuse {
namespace {

namespace mm = micromechanics;

std::size_t index(int type) {
  return static_cast<std::size_t>(type - 1);
}

FixPropertyGlobal* property(LAMMPS* lmp, const char* name, const char* kind, int rows, int columns) {
  return dynamic_cast<FixPropertyGlobal*>(
      lmp->modify->find_fix_property(name, "property/global", kind, rows, columns, "suffuse", false));
}

FixPropertyGlobal& required(LAMMPS* lmp, const std::string& who, const char* name, const char* kind, int rows,
                            int columns) {
  auto* found = property(lmp, name, kind, rows, columns);
  if (found == nullptr)
    throw_user_error({who, name, "unknown", "be defined",
                      std::string("write `fix ID all property/global ") + name + " " + kind + " ...`"});
  return *found;
}

std::vector<bool> types_of_grains(LAMMPS* lmp) {
  std::vector<int> have(static_cast<std::size_t>(lmp->atom->ntypes), 0);
  for (int i = 0; i < lmp->atom->nlocal; ++i) have[index(lmp->atom->type[i])] = 1;
  MPI_Allreduce(MPI_IN_PLACE, have.data(), static_cast<int>(have.size()), MPI_INT, MPI_MAX, lmp->world);
  return {have.begin(), have.end()};
}

/// From what the fixes tell LIGGGHTS itself: a wall of primitives its type, a mesh its own (and the wall of
/// meshes type 1, which at worst makes the step shorter).
std::vector<bool> types_of_walls(LAMMPS* lmp) {
  std::vector<bool> have(static_cast<std::size_t>(lmp->atom->ntypes), false);
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    Fix* wall = lmp->modify->fix[i];
    if (std::strcmp(wall->style, "wall/gran") != 0 && std::strncmp(wall->style, "mesh/surface", 12) != 0)
      continue;
    for (int type = std::max(1, wall->min_type()); type <= std::min(lmp->atom->ntypes, wall->max_type());
         ++type)
      have[index(type)] = true;
  }
  return have;
}

}  // namespace

PairLaw PairLaw::of(LAMMPS* lmp, const std::string& who) {
  PairGran& pair = require_granular_pair_style(lmp, who);
  PairLaw law;
  law.name_ = "another law than Hertz's or Hooke's";
  constexpr std::array kKnown{std::pair{"hertz", Kind::hertz}, std::pair{"hooke", Kind::hooke},
                              std::pair{"hooke/stiffness", Kind::hooke_stiffness}};
  for (const auto& [name, kind] : kKnown) {
    if (!pair.contact_match("normal", name)) continue;
    law.name_ = name;
    law.kind_ = kind;
  }
  const int types = lmp->atom->ntypes;
  if (law.kind_ == Kind::hooke_stiffness) {
    auto& spring = required(lmp, who, "kn", "peratomtypepair", types, types);
    for (int i = 0; i < types; ++i) {
      law.spring_.emplace_back();
      for (int j = 0; j < types; ++j) law.spring_.back().push_back(spring.compute_array(i, j));
    }
  } else {
    auto& modulus = required(lmp, who, "youngsModulus", "peratomtype", types, 0);
    auto& ratio = required(lmp, who, "poissonsRatio", "peratomtype", types, 0);
    for (int i = 0; i < types; ++i) {
      law.youngs_modulus_.push_back(modulus.compute_vector(i));
      law.poisson_ratio_.push_back(ratio.compute_vector(i));
    }
  }
  if (law.kind_ == Kind::hooke)
    law.characteristic_velocity_ =
        required(lmp, who, "characteristicVelocity", "scalar", 0, 0).compute_scalar();
  law.grains_have_ = types_of_grains(lmp);
  law.walls_have_ = types_of_walls(lmp);
  return law;
}

mm::GrainMaterial PairLaw::material(int type, double radius, double density) const {
  mm::GrainMaterial grain{0, 0, density, 2 * radius};
  if (!youngs_modulus_.empty()) {
    grain.youngs_modulus = youngs_modulus_[index(type)];
    grain.poisson_ratio = poisson_ratio_[index(type)];
  }
  return grain;
}

/// Of two types at this effective mass and radius.
double PairLaw::hooke_spring(int type, int partner, double mass, double radius) const {
  if (kind_ == Kind::hooke_stiffness) return spring_[index(type)][index(partner)];
  const auto compliance = [&](int t) {
    return (1 - poisson_ratio_[index(t)] * poisson_ratio_[index(t)]) / youngs_modulus_[index(t)];
  };
  return mm::hooke_stiffness(
      {1 / (compliance(type) + compliance(partner)), radius, mass, characteristic_velocity_});
}

double PairLaw::critical_time(int type, double radius, double density) const {
  if (!is_linear()) return mm::rayleigh_time(material(type, radius, density));
  const double mass = density * mm::sphere_volume(radius);
  double shortest = std::numeric_limits<double>::infinity();
  for (int partner = 1; partner <= static_cast<int>(grains_have_.size()); ++partner) {
    if (grains_have_[index(partner)])
      shortest = std::min(shortest,
                          mm::contact_duration(mass / 2, hooke_spring(type, partner, mass / 2, radius / 2)));
    if (walls_have_[index(partner)])
      shortest = std::min(shortest, mm::contact_duration(mass, hooke_spring(type, partner, mass, radius)));
  }
  return shortest;
}

double PairLaw::spring_of_like_grains(int type, double radius, double density) const {
  return hooke_spring(type, type, density * mm::sphere_volume(radius) / 2, radius / 2);
}

double PairLaw::oscillation_time(int type, double radius, double density, double mean_stress) const {
  if (!is_linear()) return mm::oscillation_time(material(type, radius, density), mean_stress);
  return std::sqrt(density * mm::sphere_volume(radius) / spring_of_like_grains(type, radius, density));
}

double PairLaw::stiffness_number(int type, double radius, double density, double mean_stress) const {
  if (!is_linear()) return mm::stiffness_number(material(type, radius, density), mean_stress);
  return mm::linear_stiffness_number(spring_of_like_grains(type, radius, density), 2 * radius, mean_stress);
}

CriticalGrain critical_grain(LAMMPS* lmp, const PairLaw& law, double mean_stress) {
  const auto* atom = lmp->atom;
  CriticalGrain found;
  found.time = found.oscillation_time = found.stiffness_number = std::numeric_limits<double>::infinity();
  for (int i = 0; i < atom->nlocal; ++i) {
    const double radius = atom->radius[i], density = atom->rmass[i] / mm::sphere_volume(radius);
    found.oscillation_time =
        std::min(found.oscillation_time, law.oscillation_time(atom->type[i], radius, density, mean_stress));
    found.stiffness_number =
        std::min(found.stiffness_number, law.stiffness_number(atom->type[i], radius, density, mean_stress));
    const double time = law.critical_time(atom->type[i], radius, density);
    if (time >= found.time) continue;
    found.time = time;
    found.radius = radius;
    found.inertial_density = density;
    found.true_density = atom->density[i];
    found.type = atom->type[i];
  }
  struct {
    double time;
    int rank;
  } least{found.time, lmp->comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, &found.oscillation_time, 1, MPI_DOUBLE, MPI_MIN, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, &found.stiffness_number, 1, MPI_DOUBLE, MPI_MIN, lmp->world);
  std::array<double, 5> values{found.time, found.radius, found.inertial_density, found.true_density,
                               static_cast<double>(found.type)};
  MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, least.rank, lmp->world);
  found.time = values[0];
  found.radius = values[1];
  found.inertial_density = values[2];
  found.true_density = values[3];
  found.type = static_cast<int>(values[4]);
  return found;
}

}  // namespace suffuse
