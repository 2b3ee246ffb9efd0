#pragma once

#include <cstdint>
#include <string>

#include "../commands/wall_limit.h"
#include "verlet.h"

namespace suffuse::coupling {

/// What `restart_set` asks for.
struct SetRequest {
  std::string file;
  std::int64_t every = 0;  ///< steps: sets are saved in those that are multiples of it
  WallLimit limit;
};

/// LIGGGHTS's Verlet integration that saves restart sets (saved_set.h) in the steps of a request, whoever
/// runs it by `run`. It goes on from each as a run that takes it up (restart_instant.h). Signals and the
/// wall-time limit are looked at now and then: the run ends with a set and Interrupted, on all ranks.
class SavingVerlet final : public LAMMPS_NS::Verlet {
 public:
  SavingVerlet(LAMMPS_NS::LAMMPS* lmp, SetRequest request);
  void run(int steps) override;

 private:
  void save();
  int stop_here() const;

  SetRequest request_;
};

/// Script command `restart_set FILE every N [stop after TIME]`, or `restart_set off`: from the next `run` on.
void restart_set(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

/// A UserError where sets of grains alone are being saved: with water they would be half a state.
void require_no_sets_of_grains(LAMMPS_NS::LAMMPS* lmp, const std::string& who);

}  // namespace suffuse::coupling
