#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "../commands/wall_limit.h"
#include "verlet.h"

namespace suffuse::coupling {

/// What `restart_set` asks for.
struct SetRequest {
  std::string file;        ///< empty: no sets; a run that is stopped leaves stopped_STEP.restart
  std::int64_t every = 0;  ///< steps: sets are saved in those that are multiples of it
  WallLimit limit;
};

/// LIGGGHTS's Verlet integration that saves restart sets (saved_set.h) in the steps of a request, whoever
/// runs it by `run`. It goes on from each as a run that takes it up (restart_instant.h). Signals and the
/// wall-time limit are looked at some ten times a second: the run ends with what is saved and Interrupted, on
/// all ranks. A long run says now and then how far it is and how long the rest takes.
class SavingVerlet final : public LAMMPS_NS::Verlet {
 public:
  SavingVerlet(LAMMPS_NS::LAMMPS* lmp, SetRequest request);
  void run(int steps) override;

 private:
  using Clock = std::chrono::steady_clock;
  void save();
  void save_where_stopped(const std::string& file);
  int stop_here() const;
  [[noreturn]] void end(int stop);
  void tell_progress();

  SetRequest request_;
  std::int64_t first_ = 0, next_ = -1;  ///< steps: of this run, and the one with which it would go on
  Clock::time_point began_, told_;      ///< this run, and its last line
};

/// The command `run` where the script saves no sets: LIGGGHTS's, with signals and progress as above.
void run_watched(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

/// Script command `restart_set FILE every N [stop after TIME]`, or `restart_set off`: from the next `run` on.
void restart_set(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

}  // namespace suffuse::coupling
