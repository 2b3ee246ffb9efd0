#pragma once

#include <vector>

#include "grain_questions.h"
#include "run_control.h"
#include "suffuse/coupling/particle_port.h"

namespace LAMMPS_NS {
class FixHydrodynamicForce;
}

namespace suffuse::coupling {

/// The spheres of a LIGGGHTS instance as the coupling reads and moves them, with what can be asked of them
/// and how LIGGGHTS runs.
class LiggghtsPort final : public ParticlePort, public GrainQuestions, public RunControl {
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
  bool reads_loads(int substeps) override { return makes_a_step_within(substeps); }
  double time_step() const override;
  void advance(int substeps) override;

  /// Within a run, before its state is saved: restart_instant.h. What grains() and memory() gave is no longer
  /// valid. Collective.
  void set_up_again();
  /// The same where fixes have come or gone since `begin`. Collective.
  void set_up_with_new_fixes();

 private:
  void view_all();
  void copy_group();
  void keep_memory();

  LAMMPS_NS::LAMMPS* lmp_;
  LAMMPS_NS::FixHydrodynamicForce* fix_ = nullptr;  ///< as of the last `refresh`
  bool made_fix_ = false;
  bool all_grains_ = true;  ///< the fix's group is `all`
  GrainArrays arrays_;
  std::vector<int> local_;  ///< with a part of the grains: their places in LIGGGHTS's arrays, owned first
  std::vector<double> position_, velocity_, spin_, radius_, mass_, load_;
  std::vector<GrainRecord> records_;
  std::vector<int> id_;
};

}  // namespace suffuse::coupling
