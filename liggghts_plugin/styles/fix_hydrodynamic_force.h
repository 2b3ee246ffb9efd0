#ifdef FIX_CLASS

// clang-format off
FixStyle(hydrodynamic/force, FixHydrodynamicForce)
// clang-format on

#else

#ifndef SUFFUSE_FIX_HYDRODYNAMIC_FORCE_H
#define SUFFUSE_FIX_HYDRODYNAMIC_FORCE_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

/// fix ID group hydrodynamic/force: holds the fluid's force and torque on every grain of the group and adds
/// them in every step until they are given anew. Reference page: docs/reference/fix_hydrodynamic_force.md.
///
/// Values go with a grain when it changes rank and into restart files. Whoever computes the loads writes them
/// with `load` and `history`, and calls `loads_changed` before the next step.
class FixHydrodynamicForce : public Fix {
 public:
  static constexpr int kLoadValues = 6;      ///< force (N), torque about the centre (N m)
  static constexpr int kHistoryValues = 16;  ///< the coupling's memory of a grain (particle_port.h)

  FixHydrodynamicForce(LAMMPS* lmp, int narg, char** arg);
  ~FixHydrodynamicForce() override;

  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
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

  int pack_comm(int n, int* list, double* buffer, int pbc_flag, int* pbc) override;
  void unpack_comm(int n, int first, double* buffer) override;
  int pack_reverse_comm(int n, int first, double* buffer) override;
  void unpack_reverse_comm(int n, int* list, double* buffer) override;

  /// Of owned grains, contiguous, kLoadValues and kHistoryValues a grain; valid until grains migrate.
  double* load();
  double* history();

  /// Brings the forces that the next half step of integration starts with up to date with the loads.
  void loads_changed();

  /// Mass of fluid (kg per m^3 of grain) that is added to both sides of the equations of motion, moving with
  /// the acceleration of the last fluid step: explicit coupling of grains lighter than about the fluid would
  /// diverge without (thesis eq 3.38 has none; docs/decisions/virtual-mass.md). 0: none.
  void set_virtual_density(double density) { virtual_density_ = density; }

  /// Copies velocities and angular velocities of owned grains to their ghosts. LIGGGHTS leaves the ghosts'
  /// half a step behind. Collective.
  void update_ghost_velocities();

  /// Adds what ghosts hold in `force` and `torque` (3 for each of owned and ghost grains) to their owners.
  /// Collective.
  void sum_over_ghosts(std::vector<double>& forces, std::vector<double>& torques);

 private:
  double virtual_mass(int i) const;
  void contribution(int i, double* added) const;

  double** history_ = nullptr;
  std::vector<double> applied_;  // force part of what atom->f holds of ours, 3 a grain
  std::vector<double> applied_torque_;
  double virtual_density_ = 0;
  std::vector<double>* sum_force_ = nullptr;  // set during sum_over_ghosts
  std::vector<double>* sum_torque_ = nullptr;
};

}  // namespace LAMMPS_NS

#endif
#endif
