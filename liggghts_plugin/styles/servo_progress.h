#pragma once

// What `fix stress/servo` says while it works.

#include <cstdint>
#include <string>

#include "laws/stress_servo.h"

namespace suffuse {

/// Where a servo stands.
struct ServoStanding {
  std::int64_t step = 0, last_step = 0;  ///< now, and of the run
  servo::Phase phase = servo::Phase::approaching;
  double mean_stress = 0, deviator = 0;  ///< Pa
  double void_ratio = 0, coordination = 0, strain = 0, inertial_number = 0, unbalanced = 0;
  double static_steps = 0;  ///< steps until `static` may be met
};

/// Progress lines, one in so many seconds of wall clock, with the time that is left to the goal, extrapolated
/// from the line before.
class ServoProgress {
 public:
  /// A run begins. `wall` is the wall clock, s.
  void begin(const ServoStanding& now, double wall);

  /// The line, if `every` seconds have passed since the last, or nothing. `every` = 0: never.
  std::string line(const std::string& id, const servo::Settings& settings, const ServoStanding& now,
                   double wall, double every);

 private:
  double minutes_left(const servo::Settings& settings, const ServoStanding& now, double since) const;

  double wall_ = 0;
  ServoStanding last_;
};

/// How the path ended: what was met, and how well the grains balance their forces there.
std::string describe_end(const std::string& id, servo::Stop stop, const ServoStanding& now);

}  // namespace suffuse
