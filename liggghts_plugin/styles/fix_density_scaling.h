#ifdef FIX_CLASS

// clang-format off
FixStyle(density/scaling, FixDensityScaling)
// clang-format on

#else

#ifndef SUFFUSE_FIX_DENSITY_SCALING_H
#define SUFFUSE_FIX_DENSITY_SCALING_H

#include <array>
#include <memory>

#include "fix.h"
#include "pair_law.h"

namespace LAMMPS_NS {

class FixContactSampler;

/// `fix ID group density/scaling size D | rayleigh T [bound I] [every N]`: gives small grains more inertia,
/// so that they allow the time step of a larger one. Reference page: docs/reference/fix_density_scaling.md.
///
/// LIGGGHTS keeps a grain's `density` beside its `rmass`. Integration and contact damping read `rmass`; that
/// alone is scaled, and always formed anew from `density`, radius and type. So the true density migrates,
/// reaches ghosts and stands in restart files as LIGGGHTS has it, and nothing can be scaled twice. Ghosts
/// have both values: they are scaled here as their owners are, each time that neighbours are found.
///
/// Weight: `fix gravity` takes the scaled mass. A grain that no other force touches is left to it and falls
/// with g; of one that touched something in the last step, the surplus is taken off before the forces are
/// formed, so that it presses with its true weight.
class FixDensityScaling : public Fix {
 public:
  FixDensityScaling(LAMMPS* lmp, int narg, char** arg);
  ~FixDensityScaling() override;

  void post_create() override;
  void pre_delete(bool unfixflag) override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_pre_neighbor() override;
  void pre_neighbor() override;
  void setup_pre_force(int) override;
  void pre_force(int) override;
  void end_of_step() override;
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  void unpack_restart(int i, int nth) override;
  double compute_vector(int n) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  int pack_restart(int i, double* buffer) override;
  int size_restart(int i) override;
  int maxsize_restart() override;

 private:
  /// Over the grains whose factor is above 1, on all ranks.
  struct Scaled {
    double grains = 0, true_mass = 0, inertia = 0, true_mass_of_all = 0;
    double largest_factor = 1;
    double largest_inertial_size = 0;  ///< largest d √(ρ factor), √(kg/m)
  };

  double factor(int i) const;
  void scale(int first, int last);
  void restore_true_masses();
  void require_true_masses_at_first();
  void require_compatible_fixes() const;
  void require_sane_factors() const;
  void find_gravity();
  void find_touching();
  void remember_box();
  Scaled scaled_grains();
  void sample();
  void warn_above_bound();

  bool by_size_ = true;
  double diameter_ = 0;        // m, reference
  double share_ = 0;           // of the critical time
  double reference_time_ = 0;  // s
  double bound_ = 1e-4;        // of the inertial number (docs/reference/fix_density_scaling.md, Measured)
  bigint every_ = 1000;
  std::unique_ptr<suffuse::PairLaw> law_;
  bool first_init_ = true;
  FixContactSampler* sampler_ = nullptr;
  struct Gravity;
  std::unique_ptr<Gravity> gravity_;
  double* touching_ = nullptr;  // per atom: 1 if something but gravity acted on it in the last step, or 0
  std::array<double, 3> lengths_{};  // of the box at the last sample, m
  bigint sampled_step_ = 0;
  double inertial_number_ = 0;
  double unbalanced_ = 0;
  bool warned_ = false;
};

}  // namespace LAMMPS_NS

#endif
#endif
