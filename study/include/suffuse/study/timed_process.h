#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace suffuse::study {

/// How a program ended, and what it took.
struct ProcessEnd {
  enum class How { exited, by_signal, too_long, interrupted };

  How how = How::exited;
  int code = 0;            ///< exit code, or the signal's number
  double wall = 0;         ///< seconds by the clock
  double core = 0;         ///< core seconds, user and system, of it and all that it started
  double other_cores = 0;  ///< cores that other programs kept busy meanwhile, on average
};

/// What is started: the words of its command line, and its folder, in which `log` takes output and errors.
struct ProcessCommand {
  std::vector<std::string> words;
  std::string folder, log;
  double limit = 0;  ///< seconds after which it is ended; 0: none
};

/// Programs that run at once, each in a process group of its own. What takes longer than its limit is ended
/// with all that it started (SIGTERM, ten seconds later SIGKILL); so are all of them on a signal
/// (SignalWatch), and those that still run when this goes out of scope. What one leaves in its group when it
/// ends is killed.
class TimedProcesses {
 public:
  TimedProcesses() = default;
  ~TimedProcesses();
  TimedProcesses(const TimedProcesses&) = delete;
  TimedProcesses& operator=(const TimedProcesses&) = delete;

  /// Throws UserError where it cannot be started. `id` is the caller's.
  void start(std::size_t id, const ProcessCommand& command);
  std::size_t running() const { return running_.size(); }
  /// Waits until one has ended, and gives its id. One at least is running.
  std::pair<std::size_t, ProcessEnd> wait_for_one();

 private:
  struct Running {
    std::size_t id = 0;
    int process = 0;
    double limit = 0, begin = 0, busy_before = 0;  ///< seconds; of the clock, and of the machine's cores
    double asked = 0;                              ///< when it was asked to end
    ProcessEnd::How how = ProcessEnd::How::exited;
  };

  static void ask_to_end(Running& one, ProcessEnd::How why);
  static std::optional<ProcessEnd> end_of(Running& one);

  std::vector<Running> running_;
};

/// One program, from start to end.
ProcessEnd run_timed(const ProcessCommand& command);

}  // namespace suffuse::study
