#include "suffuse/common/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace suffuse {

ProgressLine::ProgressLine(bool speaks)
    : speaks_(speaks), terminal_(isatty(fileno(stderr)) == 1), start_(Clock::now()), last_(start_) {}

void ProgressLine::update(double done, const std::function<std::string()>& details) {
  if (!speaks_) return;
  const Clock::time_point now = Clock::now();
  const int tenths = static_cast<int>(done * 10);
  const bool due = terminal_ ? now - last_ > std::chrono::milliseconds(500) : tenths > tenths_;
  if (!due) return;
  last_ = now;
  tenths_ = tenths;
  print(done, details());
}

void ProgressLine::finish(const std::string& details, double done) {
  if (!speaks_) return;
  if (terminal_ || tenths_ < 10) print(done, details);
  if (terminal_) std::fputc('\n', stderr);
}

void ProgressLine::print(double done, const std::string& details) {
  const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
  const std::string left = done > 0 && done < 1 ? duration_text(spent * (1 - done) / done) + " left" : "";
  const std::string line = fmt::format("{:5.1f} %  {}  {}", 100 * done, details, left);
  if (terminal_)
    fmt::print(stderr, "\r{:<110}", line);
  else
    fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
}

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  constexpr double year = 365.25 * 86400;
  if (!(seconds < 10 * year)) return fmt::format("{:.3g} years", seconds / year);
  const long whole = static_cast<long>(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace suffuse
