#include "film_forces.h"

#include <algorithm>
#include <string>

#include "fix.h"
#include "force_fix.h"
#include "group.h"
#include "lammps.h"
#include "modify.h"
#include "styles/fix_hydrodynamic_force.h"
#include "styles/fix_lubrication.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kFix = "suffuse_lubrication";

/// The fix that acts, whoever defined it; null without.
const LAMMPS_NS::FixLubrication* find(LAMMPS_NS::LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (const auto* fix = dynamic_cast<const LAMMPS_NS::FixLubrication*>(lmp->modify->fix[i])) return fix;
  return nullptr;
}

}  // namespace

std::string FilmForces::of_script(LAMMPS_NS::LAMMPS* lmp) {
  const LAMMPS_NS::FixLubrication* fix = find(lmp);
  return fix == nullptr || std::string(fix->id) == kFix ? "" : fix->id;
}

void FilmForces::withdraw(LAMMPS_NS::LAMMPS* lmp) {
  if (lmp->modify->find_fix(kFix) < 0) return;
  of_past_ = seconds(lmp);
  lmp->modify->delete_fix(kFix);
}

double FilmForces::seconds(LAMMPS_NS::LAMMPS* lmp) const {
  const LAMMPS_NS::FixLubrication* fix = find(lmp);
  return of_past_ + (fix == nullptr ? 0 : fix->seconds());
}

bool FilmForces::follow(const Scene& scene, const Water& water) {
  if (!of_script(scene.lmp).empty()) return false;
  const EffectSettings& effects = scene.simulation.effects();
  const bool on = effects.lubrication == Switch::on;
  const bool is_there = scene.lmp->modify->find_fix(kFix) >= 0;
  const Made wanted{water, scene.simulation.substeps(), effects.rotation != Switch::off};
  if (is_there == on && (!on || made_ == wanted)) return false;
  withdraw(scene.lmp);
  made_ = wanted;
  if (on) add(scene);
  return true;
}

/// The lattice resolves what is wider than two thirds of a cell; films end at the grains' roughness, a
/// thousandth of the smallest radius.
void FilmForces::add(const Scene& scene) const {
  const CoupledSimulation& simulation = scene.simulation;
  const lbm::Units& units = simulation.units();
  const LiggghtsPort::Summary grains = scene.port.summary();
  LAMMPS_NS::FixLubrication::Settings settings;
  settings.film.viscosity = units.density() * units.viscosity_si();
  settings.film.outer = std::min(2. / 3 * units.spacing(), grains.largest_radius);
  settings.film.inner = 1e-3 * grains.smallest_radius;
  settings.every = std::max(1, made_.substeps / 2);
  settings.region = made_.water.region;
  settings.torque = made_.torque;
  const lbm::Index3 cells = simulation.fluid().decomposition().cells();
  for (int f = 0; f < lbm::kFaces; ++f) {
    const int axis = f / 2;
    if (simulation.fluid().settings().faces[static_cast<std::size_t>(f)].kind == lbm::FaceKind::no_slip)
      settings.walls.push_back(
          {axis, simulation.origin()[axis] + (f % 2 == 1 ? units.spacing() * cells[axis] : 0)});
  }
  for (const auto& [axis, position] : made_.water.planes) settings.walls.push_back({axis, position});
  const LAMMPS_NS::Fix& force = force_fix(scene.lmp);
  std::vector<std::string> words =
      LAMMPS_NS::FixLubrication::words(kFix, scene.lmp->group->names[force.igroup], settings);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  scene.lmp->modify->add_fix(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace suffuse::coupling
