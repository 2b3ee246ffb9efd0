#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace suffuse {

/// What a long run tells while it goes on: one line that is rewritten on a terminal, or a new line every
/// tenth of the run in a file. Silent on all ranks but the first.
class ProgressLine {
 public:
  explicit ProgressLine(bool speaks);

  /// `done` in 0..1; `details` gives whatever the run wants to show besides per cent and time left, and is
  /// only called to be shown. At most twice a second on a terminal.
  void update(double done, const std::function<std::string()>& details);
  /// Ends the line; prints it a last time. `done` is less than 1 where the run was cut short.
  void finish(const std::string& details, double done = 1);

 private:
  using Clock = std::chrono::steady_clock;
  void print(double done, const std::string& details);

  bool speaks_, terminal_;
  Clock::time_point start_, last_;
  int tenths_ = -1;
};

/// "3 h 05 min", "12 min 30 s", "4.2 s".
std::string duration_text(double seconds);

}  // namespace suffuse
