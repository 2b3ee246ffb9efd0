#pragma once

#include <string>
#include <vector>

namespace suffuse::analysis {

/// How a program ended, and what it took.
struct ProcessEnd {
  enum class How { exited, by_signal, too_long, interrupted };

  How how = How::exited;
  int code = 0;            ///< exit code, or the signal's number
  double wall = 0;         ///< seconds by the clock
  double core = 0;         ///< core seconds, user and system, of it and all that it started
  double other_cores = 0;  ///< cores that other programs kept busy meanwhile, on average
};

/// Runs a program in a folder, its output and errors in `log` there, and waits for it. `limit` in seconds (0:
/// none): what takes longer is ended, with all that it started (SIGTERM, ten seconds later SIGKILL); so it is
/// on a signal (SignalWatch). Throws UserError where it cannot be started.
ProcessEnd run_timed(const std::vector<std::string>& words, const std::string& folder, const std::string& log,
                     double limit);

}  // namespace suffuse::analysis
