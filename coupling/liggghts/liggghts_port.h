#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "suffuse/coupling/particle_port.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/fluid.h"
#include "suffuse/micromechanics/contact_network.h"

namespace LAMMPS_NS {
class LAMMPS;
class FixHydrodynamicForce;
}  // namespace LAMMPS_NS

namespace suffuse::coupling {

/// LIGGGHTS's last run in this process.
struct PastRun {
  double grain_steps = 0;  ///< steps times grains; 0: none that is long enough to tell
  double seconds = 0;
};

/// The spheres of a LIGGGHTS instance. Between `begin` and `end` LIGGGHTS is inside one run: it is set up
/// once, and `advance` goes on by some steps, with thermo output, dumps and fixes as in `run`.
class LiggghtsPort final : public ParticlePort {
 public:
  /// Makes `fix hydrodynamic/force` for all grains if the script has none. A UserError if the grains are not
  /// spheres. Collective.
  explicit LiggghtsPort(LAMMPS_NS::LAMMPS* lmp);
  /// Takes the fix back if this port made it: as if there had been no port.
  void withdraw();

  void refresh() override;
  GrainArrays grains() const override { return arrays_; }
  void sum_over_copies(std::vector<GrainSums>& sums) override;
  GrainMemory memory() override;
  bool reads_loads(int substeps) override;
  double time_step() const override;
  void advance(int substeps) override;

  /// Sets LIGGGHTS up for a run of at most so many steps. Collective.
  void begin(std::int64_t steps);
  /// Within a run, before its state is saved: restart_instant.h. What grains() and memory() gave is no longer
  /// valid. Collective.
  void set_up_again();
  /// The same where fixes have come or gone since `begin`. Collective.
  void set_up_with_new_fixes();
  /// The next `advance` shall be the last: the thermo line and dumps of the end are written in it.
  void end_after(int substeps);
  void end();

  /// Tells scripts (`f_ID`) how long the fluid has flowed, s; from `begin` to `end` of a run its time goes on
  /// with the grains' steps.
  void set_fluid_time(double seconds);

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

  /// 0, or why the run shall end: kFixStops, or the number of the signal that has come to some rank
  /// (`signal`: on this one, 0 for none). The same on all ranks. Collective.
  int stop_requested(int signal = 0) const;
  static constexpr int kFixStops = 1;  ///< less than the numbers of the signals that ask a program to end

  /// Computes will be asked for values when the next so many steps are done.
  void announce_values(int substeps);

  /// Contacts can be asked for in the runs that begin after this: a UserError where no granular pair style
  /// makes any. Collective.
  void use_contacts();
  /// They will be when the next so many steps are done: found among these steps' forces, they are those that
  /// move the grains and that our computes see.
  void announce_contacts(int substeps);
  /// This rank's grains of the fix's group, their contacts with each other, and the box, now. Valid until
  /// `advance`. Collective.
  const micromechanics::Packing& contacts();

  /// Which faces of LIGGGHTS's box are periodic: those across x, y, z.
  std::array<bool, 3> periodic() const;

  /// Sets LIGGGHTS's time step, s; one that differs by round-off alone stays as it is. A UserError where a
  /// fix of the script does not let it change.
  void set_time_step(double step);

  /// A UserError where the box is not the one that the fluid was made for, or grains cannot be mapped:
  /// shrink-wrapped or periodic faces that disagree with the fluid's, bodies that are not spheres.
  void check_box(const lbm::FaceConditions& faces) const;
  /// A UserError if the box changed since `begin`.
  void check_unchanged() const;

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
    Vec3 extent = Vec3::Zero();                        ///< of the box around all grains, m
    double packing = 0;                                ///< solid volume over that of this box
    double kinetic_energy = 0;                         ///< J
    double speed = 0;                                  ///< of the fastest centre, m/s
    Vec3 load = Vec3::Zero();                          ///< sum of the fluid's forces, N
  };
  Summary summary() const;

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
  void view_all();
  void copy_group();
  void keep_memory();
  void keep_box();
  bool acts_in_every_step() const;
  std::int64_t next_step_that_counts() const;

  LAMMPS_NS::LAMMPS* lmp_;
  LAMMPS_NS::FixHydrodynamicForce* fix_ = nullptr;
  bool running_ = false;
  bool made_fix_ = false;
  bool moves_ = false;
  bool every_step_ = false;           ///< some fix does more in every step than what the next one does again
  std::int64_t announced_step_ = -1;  ///< whose values somebody will ask for
  bool all_grains_ = true;            ///< the fix's group is `all`
  GrainArrays arrays_;
  std::array<double, 6> box_{};
  std::vector<int> local_;  ///< with a part of the grains: their places in LIGGGHTS's arrays, owned first
  std::vector<double> position_, velocity_, spin_, radius_, mass_, load_;
  std::vector<GrainRecord> records_;
  std::vector<int> id_;
};

}  // namespace suffuse::coupling
