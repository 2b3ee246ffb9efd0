#ifdef FIX_CLASS

// clang-format off
FixStyle(hydrodynamic/force, FixHydrodynamicForce)
// clang-format on

#else

#ifndef SUFFUSE_FIX_HYDRODYNAMIC_FORCE_H
#define SUFFUSE_FIX_HYDRODYNAMIC_FORCE_H

#include <vector>

#include "fix.h"
#include "laws/grain_record.h"

namespace LAMMPS_NS {

/// fix ID group hydrodynamic/force: holds the fluid's force and torque on every grain of the group and adds
/// them in every step until they are given anew. Reference page: docs/reference/fix_hydrodynamic_force.md.
///
/// Values go with a grain when it changes rank and into restart files. Whoever computes the loads writes them
/// with `load` and `records`, and calls `loads_changed` before the next step. Fixes of the script that set
/// forces (`freeze`, `setforce`, ...) act after it, whatever the order of their lines: what they hold stays
/// held.
class FixHydrodynamicForce : public Fix {
 public:
  static constexpr int kLoadValues = 6;  ///< force (N), torque about the centre (N m)

  FixHydrodynamicForce(LAMMPS* lmp, int narg, char** arg);
  ~FixHydrodynamicForce() override;

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup(int) override;
  void pre_initial_integrate() override;
  void post_force(int) override;
  void pre_final_integrate() override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  double memory_usage() override;

  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;

  void write_restart(FILE* file) override;
  void restart(char* state) override;

  int pack_comm(int n, int* list, double* buffer, int pbc_flag, int* pbc) override;
  void unpack_comm(int n, int first, double* buffer) override;
  int pack_reverse_comm(int n, int first, double* buffer) override;
  void unpack_reverse_comm(int n, int* list, double* buffer) override;

  /// Of owned grains, contiguous, kLoadValues and one record a grain; valid until grains migrate.
  double* load();
  suffuse::GrainRecord* records();
  /// Has a restart file given grains of this rank their values back?
  bool restored() const { return restored_; }

  /// The fluid has come to this time (s) now; while it flows its time goes on with the grains' steps.
  enum class Fluid { flows, rests };
  void set_fluid_time(double seconds, Fluid fluid);

  /// A fluid step gave these loads: brings the forces that the next half step of integration starts with up
  /// to date. From here to `interval_over` the virtual drag of the records acts beside them.
  void loads_changed();
  void interval_over();

  /// The loads act from here on, or no longer: a plain `run` moves grains without water. They stay with the
  /// grains, for dumps, restart files and the run that goes on.
  void set_in_water(bool in_water) { in_water_ = in_water; }
  /// There is no fluid any more that loads and records could be of.
  void forget();

  /// Copies velocities and angular velocities of owned grains to their ghosts. LIGGGHTS leaves the ghosts'
  /// half a step behind. Collective.
  void update_ghost_velocities();

  /// Adds what ghosts hold in `values` (kSumValues for each of owned and ghost grains) to their owners.
  /// Collective.
  static constexpr int kSumValues = 12;
  void sum_over_ghosts(double* values);

 private:
  /// What this fix adds to a grain's force and torque: the load, what is returned and, within an interval,
  /// the virtual drag. That is implicit in the half step of velocity that follows, for which the sum of all
  /// forces is multiplied by m/(m + added mass + drag dt/2), and so with the torque.
  struct Addition {
    double force[3], torque[3];
    double force_share, torque_share;
    bool changes;  ///< from step to step: there is a drag, or something is returned
  };
  Addition load_alone(int i) const;
  Addition addition(int i) const;
  void withhold(double seconds);
  void change_constrained(int owned);
  void finish_setup();
  void require_records_of_this_version();

  std::vector<suffuse::GrainRecord> records_;
  std::vector<Fix*> constraints_;  // of the script, in their order
  std::vector<Addition> applied_;  // what atom->f and atom->torque hold of ours
  bool stale_ = true;              // grains have changed places since then
  bool in_water_ = false;
  bool in_interval_ = false;  // between a fluid step and the next
  bool setting_up_ = false;   // fixes that come later have still to add their forces of the set-up
  bool restored_ = false;
  int foreign_records_ = 0;  // of a restart file, that this version cannot read
  double fluid_time_ = 0;    // s, at the step fluid_step_
  bigint fluid_step_ = 0;
  Fluid fluid_ = Fluid::rests;
  double* sums_ = nullptr;  // set during sum_over_ghosts
};

}  // namespace LAMMPS_NS

#endif
#endif
