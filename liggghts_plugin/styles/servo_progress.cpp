#include "servo_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace suffuse {

void ServoProgress::begin(const ServoStanding& now, double wall) {
  last_ = now;
  wall_ = wall;
}

/// Negative if nothing tells.
double ServoProgress::minutes_left(const servo::Settings& settings, const ServoStanding& now,
                                   double since) const {
  const double steps = static_cast<double>(now.step - last_.step);
  if (steps <= 0) return -1;
  const double by_run = since / steps * static_cast<double>(now.last_step - now.step);
  double by_goal = by_run;
  if (now.phase == servo::Phase::approaching) {
    const double gained = now.mean_stress - last_.mean_stress;
    if (gained <= 0) return -1;
    by_goal = since * (settings.target - now.mean_stress) / gained;
  } else if (settings.stop == servo::Stop::axial_strain) {
    const double gained = std::abs(now.strain) - std::abs(last_.strain);
    if (gained <= 0) return -1;
    by_goal = since * (settings.stop_value - std::abs(now.strain)) / gained;
  } else if (settings.stop == servo::Stop::static_state) {
    by_goal = since / steps * now.static_steps;
  }
  return std::max(0.0, std::min(by_goal, by_run)) / 60;
}

std::string ServoProgress::line(const std::string& id, const servo::Settings& settings,
                                const ServoStanding& now, double wall, double every) {
  const double since = wall - wall_;
  if (every <= 0 || since < every) return {};
  static constexpr std::array<const char*, 3> kPhases{"approaching", "holding", "done"};
  const double minutes = minutes_left(settings, now, since);
  begin(now, wall);
  return fmt::format(
      "fix stress/servo {}: step {}  {}  p' {:.4g} kPa  q {:.4g} kPa  e {:.4f}  Z {:.3f}  axial strain "
      "{:.3f} %  I {:.2g}  left {}\n",
      id, now.step, kPhases[static_cast<std::size_t>(now.phase)], now.mean_stress / 1e3, now.deviator / 1e3,
      now.void_ratio, now.coordination, 100 * now.strain, now.inertial_number,
      minutes < 0 ? "unknown" : fmt::format("{:.1f} min", minutes));
}

std::string describe_end(const std::string& id, servo::Stop stop, const ServoStanding& now) {
  static constexpr std::array<const char*, 5> kEnds{"done", "target reached", "static",
                                                    "axial strain reached", "cycles done"};
  return fmt::format(
      "fix stress/servo {}: {} at step {}: p' {:.5g} kPa, e {:.4f}, Z {:.3f}, unbalanced-force ratio "
      "{:.2g}\n",
      id, kEnds[static_cast<std::size_t>(stop)], now.step, now.mean_stress / 1e3, now.void_ratio,
      now.coordination, now.unbalanced);
}

}  // namespace suffuse
