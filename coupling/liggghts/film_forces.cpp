#include "film_forces.h"

#include <algorithm>
#include <string>

#include "fix.h"
#include "lammps.h"
#include "modify.h"
#include "styles/fix_lubrication.h"

namespace suffuse::coupling {

namespace {
constexpr const char* kFix = "suffuse_lubrication";
}

const LAMMPS_NS::FixLubrication* FilmForces::find(LAMMPS_NS::LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (const auto* fix = dynamic_cast<const LAMMPS_NS::FixLubrication*>(lmp->modify->fix[i])) return fix;
  return nullptr;
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

bool FilmForces::follow(LAMMPS_NS::LAMMPS* lmp, bool on, double smallest_radius,
                        const CoupledSimulation& simulation, const Planes& planes) {
  const bool is_ours = lmp->modify->find_fix(kFix) >= 0;
  if (!is_ours && find(lmp) != nullptr) return false;
  if (is_ours == on && (!on || (planes == planes_ && simulation.substeps() == substeps_))) return false;
  withdraw(lmp);
  planes_ = planes;
  substeps_ = simulation.substeps();
  if (on) add(lmp, smallest_radius, simulation);
  return true;
}

/// The lattice resolves what is wider than two thirds of a cell; films end at the grains' roughness, a
/// thousandth of the smallest radius.
void FilmForces::add(LAMMPS_NS::LAMMPS* lmp, double smallest_radius, const CoupledSimulation& simulation) {
  const lbm::Units& units = simulation.units();
  lubrication::Film film;
  film.viscosity = units.density() * units.viscosity_si();
  film.outer = 2. / 3 * units.spacing();
  film.inner = 1e-3 * smallest_radius;
  const int every = std::max(1, simulation.substeps() / 2);
  std::vector<LAMMPS_NS::FixLubrication::Plane> walls;
  const Vec3 size = units.spacing() * Vec3(simulation.fluid().decomposition().cells()[0],
                                           simulation.fluid().decomposition().cells()[1],
                                           simulation.fluid().decomposition().cells()[2]);
  for (int f = 0; f < lbm::kFaces; ++f)
    if (simulation.fluid().settings().faces[static_cast<std::size_t>(f)].kind == lbm::FaceKind::no_slip)
      walls.push_back({f / 2, simulation.origin()[f / 2] + (f % 2 == 1 ? size[f / 2] : 0)});
  for (const auto& [axis, position] : planes_) walls.push_back({axis, position});
  std::vector<std::string> words = LAMMPS_NS::FixLubrication::words(kFix, "all", film, every, walls);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  lmp->modify->add_fix(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace suffuse::coupling
