#ifdef FIX_CLASS

// clang-format off
FixStyle(stress/servo, FixStressServo)
// clang-format on

#else

#ifndef SUFFUSE_FIX_STRESS_SERVO_H
#define SUFFUSE_FIX_STRESS_SERVO_H

#include <string>

#include "fix.h"
#include "servo_arguments.h"
#include "servo_memory.h"
#include "servo_progress.h"

namespace LAMMPS_NS {

class FixContactSampler;

/// fix ID group stress/servo PATH ...: deforms the periodic box along a stress path. Reference page:
/// docs/reference/fix_stress_servo.md. Control law: laws/stress_servo.h.
class FixStressServo : public Fix {
 public:
  FixStressServo(LAMMPS* lmp, int narg, char** arg);
  ~FixStressServo() override;

  void post_create() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void reset_dt() override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

  /// On its way to its target, which it has not reached before.
  bool approaching() const { return memory_.state.phase == suffuse::servo::Phase::approaching; }

 private:
  void set_static_window();
  void schedule();
  void measure_stress();
  void measure_network();
  void control();
  void announce_stop();
  void report_progress();
  void check_sample();
  void choose_interval();
  double inertial_size() const;
  suffuse::ServoGrains grains_now() const;
  void take_grains(const suffuse::ServoGrains& grains);
  suffuse::ServoStanding standing() const;
  suffuse::Vec3 lengths() const;
  double inertial_number() const;
  double void_ratio() const;
  std::string signature() const;

  suffuse::ServoArguments arguments_;
  suffuse::ServoMemory memory_;

  bigint interval_ = 50;         // steps between control steps now
  bigint network_every_ = 1000;  // steps between samples of the contact network
  double window_ = 0;            // s
  suffuse::ServoProgress progress_;
  bigint stop_step_ = -1;  // the run ends after this step
  bigint seen_step_ = -1;  // the last one, and its length: a script may change both between runs
  double seen_dt_ = 0;
  bool restored_ = false;
  bool rate_note_given_ = false;
  FixContactSampler* sampler_ = nullptr;
  class Compute* pressure_ = nullptr;
  std::string pressure_id_;
};

}  // namespace LAMMPS_NS

#endif
#endif
