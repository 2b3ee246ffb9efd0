#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

/// LIGGGHTS inside of one run, between `begin` and `end`: it is set up once, and goes on by some steps at a
/// time, with thermo output, dumps and fixes as in `run`. Where nothing moves, only steps that count are
/// made.
class RunControl {
 public:
  /// Steps that LIGGGHTS can make in one run.
  static constexpr std::int64_t kMostSteps = std::numeric_limits<std::int32_t>::max();

  explicit RunControl(LAMMPS_NS::LAMMPS* lmp);

  /// Sets LIGGGHTS up for a run of at most so many steps. Collective.
  void begin(std::int64_t steps);
  /// The next steps that are made shall be the last: the thermo line and dumps of the end are written in
  /// them.
  void end_after(int substeps);
  void end();

  /// Will anything read the grains' loads in the next so many steps (ParticlePort::reads_loads)?
  bool makes_a_step_within(int substeps) const;
  /// Goes on by so many steps. Collective.
  void make_steps(int substeps);

  /// Tells scripts (`f_ID`) how long the fluid has flowed, s; from `begin` to `end` of a run its time goes on
  /// with the grains' steps.
  void set_fluid_time(double seconds);

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
  /// Sets LIGGGHTS's time step, s; one that differs by round-off alone stays as it is. A UserError where a
  /// fix of the script does not let it change.
  void set_time_step(double step);

  /// A UserError if the box changed since `begin`.
  void check_unchanged() const;

 private:
  void keep_box();
  bool acts_in_every_step() const;
  std::int64_t next_step_that_counts() const;

  LAMMPS_NS::LAMMPS* lmp_;
  bool running_ = false;
  bool moves_ = false;
  bool every_step_ = false;           ///< some fix does more in every step than what the next one does again
  std::int64_t announced_step_ = -1;  ///< whose values somebody will ask for
  std::array<double, 6> box_{};
};

}  // namespace suffuse::coupling
