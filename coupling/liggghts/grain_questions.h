#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/boundary.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/micromechanics/contact_network.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

/// LIGGGHTS's last run in this process.
struct PastRun {
  double grain_steps = 0;  ///< steps times grains; 0: none that is long enough to tell
  double seconds = 0;      ///< without what other programs took
};

/// What can be asked of LIGGGHTS's box and of its grains as a whole, within a run or between two: of the
/// grains of the group of `fix hydrodynamic/force`. Asking changes nothing.
class GrainQuestions {
 public:
  explicit GrainQuestions(LAMMPS_NS::LAMMPS* lmp) : lmp_(lmp) {}

  /// Does any fix integrate the motion of grains?
  bool anything_moves() const;

  /// What the script's `fix gravity` gives to grains, m/s^2; none without one. Within a run.
  std::optional<Vec3> gravity_on_grains() const;

  /// Grains of the fix's group that no fix moves and that have a velocity all the same: the fluid feels it.
  struct HeldInMotion {
    std::int64_t grains = 0;
    double speed = 0;  ///< of the fastest point on a surface, m/s
  };
  /// Collective.
  HeldInMotion held_in_motion() const;

  /// Have the grains the loads that a restart file kept? LIGGGHTS gives them only to a fix that is defined
  /// before anything is run. True without grains. Collective.
  bool loads_restored() const;

  /// This rank's grains of the fix's group, their contacts with each other, and the box, now. Valid until
  /// `advance`. Collective.
  const micromechanics::Packing& contacts() const;

  /// Which faces of LIGGGHTS's box are periodic: those across x, y, z.
  std::array<bool, 3> periodic() const;

  /// A UserError where the box is not the one that the fluid was made for, or grains cannot be mapped:
  /// shrink-wrapped or periodic faces that disagree with the fluid's, bodies that are not spheres.
  void check_box(const lbm::FaceConditions& faces) const;
  /// Corners and size of LIGGGHTS's box, m.
  Vec3 box_low() const;
  Vec3 box_high() const;
  Vec3 box_size() const;

  /// LIGGGHTS's own sub-boxes snapped to cells of a box of fluid from `low`, so that grains and cells are on
  /// the same rank.
  lbm::Decomposition decomposition(const Vec3& low, double spacing, const lbm::Index3& cells) const;

  /// All grains of the fix's group. Collective.
  struct Summary {
    std::int64_t grains = 0;
    double smallest_radius = 0, largest_radius = 0;    ///< m
    double sauter_diameter = 0;                        ///< sum d^3/sum d^2, m
    double smallest_density = 0, largest_density = 0;  ///< kg/m^3
    double solid_volume = 0;                           ///< m^3
    Vec3 low = Vec3::Zero(), extent = Vec3::Zero();    ///< of the box around all grains, m
    double packing = 0;                                ///< solid volume over that of this box
    double kinetic_energy = 0;                         ///< J
    double speed = 0;                                  ///< of the fastest centre, m/s
    Vec3 load = Vec3::Zero();                          ///< sum of the fluid's forces, N
  };
  Summary summary() const;

  /// Diameter over typical overlap of the softest contacts under a mean stress, Pa; infinite without grains.
  /// A UserError where there is no contact law. Not within a run. Collective.
  double stiffness_number(double mean_stress) const;

  /// Centres of this rank's grains of the fix's group, m.
  std::vector<Vec3> centres() const;

  /// This rank's own grains of the fix's group, as they are now, within a run or between two.
  struct OwnedGrain {
    Vec3 position;  ///< m
    double speed;   ///< m/s
    double radius;  ///< m
    double mass;    ///< kg, as LIGGGHTS moves it
  };
  std::vector<OwnedGrain> owned() const;

  /// How many grains of the fix's group have diameters in each class: below the first bound, between the
  /// first and second, ..., above the last (m, rising). Collective.
  std::vector<double> grains_by_size(const std::vector<double>& bounds) const;

  /// Mass of the same classes, with the grains' own densities, of grains whose centres lie below a coordinate
  /// along an axis, kg. Collective.
  std::vector<double> mass_by_size(const std::vector<double>& bounds, int axis, double below) const;

  /// From the timer of the last `run`. Collective.
  PastRun past_run() const;

  /// Mean of the fluid's force on the grains of a LIGGGHTS group, N; zero if it has none. Collective.
  Vec3 mean_load(int groupbit) const;

 private:
  LAMMPS_NS::LAMMPS* lmp_;
};

}  // namespace suffuse::coupling
