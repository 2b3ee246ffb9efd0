#pragma once

#include <utility>
#include <vector>

#include "suffuse/coupling/coupled_simulation.h"

namespace LAMMPS_NS {
class LAMMPS;
class FixLubrication;
}  // namespace LAMMPS_NS

namespace suffuse::coupling {

/// Films between grains as LIGGGHTS's business (docs/reference/fix_lubrication.md): the fix that `lbm effect
/// lubrication` adds and takes away. It leaves alone what the script has defined itself.
class FilmForces {
 public:
  using Planes = std::vector<std::pair<int, double>>;  ///< axis, and coordinate in m

  /// Adds or deletes the fix as `on` says, with films at no-slip faces and at `planes` in the water. LIGGGHTS
  /// must be set up anew after a change (true). Collective.
  bool follow(LAMMPS_NS::LAMMPS* lmp, bool on, double smallest_radius, const CoupledSimulation& simulation,
              const Planes& planes);
  /// Deletes the fix.
  void withdraw(LAMMPS_NS::LAMMPS* lmp);

  /// Time of this rank for films so far, those of fixes that are gone among it.
  double seconds(LAMMPS_NS::LAMMPS* lmp) const;

  /// The one that acts, whoever defined it; null without.
  static const LAMMPS_NS::FixLubrication* find(LAMMPS_NS::LAMMPS* lmp);

 private:
  void add(LAMMPS_NS::LAMMPS* lmp, double smallest_radius, const CoupledSimulation& simulation);
  Planes planes_;       ///< that the fix was made with
  int substeps_ = 0;    ///< likewise
  double of_past_ = 0;  ///< s, of fixes that are gone
};

}  // namespace suffuse::coupling
