#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene.h"

namespace suffuse::coupling {

/// Films between grains as LIGGGHTS's business (docs/reference/fix_lubrication.md): the fix that `lbm effect
/// lubrication` adds and takes away. It leaves alone what the script has defined itself.
class FilmForces {
 public:
  using Planes = std::vector<std::pair<int, double>>;  ///< axis, and coordinate in m

  /// Where the script has water.
  struct Water {
    std::string region;  ///< LIGGGHTS's, of the lattice; empty: the box
    Planes planes;       ///< walls in it
    bool operator==(const Water&) const = default;
  };

  /// Adds or deletes the fix for the grains that the fluid knows as the simulation's effects say, with films
  /// in the water, at no-slip faces and at its planes. LIGGGHTS must be set up anew after a change (true).
  /// Collective.
  bool follow(const Scene& scene, const Water& water);
  /// Deletes the fix.
  void withdraw(LAMMPS_NS::LAMMPS* lmp);

  /// Time of this rank for films so far, those of fixes that are gone among it.
  double seconds(LAMMPS_NS::LAMMPS* lmp) const;

  /// ID of the one that the script has defined itself; empty: none.
  static std::string of_script(LAMMPS_NS::LAMMPS* lmp);

 private:
  /// What the fix is made with, beside the lattice.
  struct Made {
    Water water;
    int substeps = 0;
    bool torque = true;
    bool operator==(const Made&) const = default;
  };

  void add(const Scene& scene) const;

  Made made_;
  double of_past_ = 0;  ///< s, of fixes that are gone
};

}  // namespace suffuse::coupling
