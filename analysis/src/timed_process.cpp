#include "suffuse/analysis/timed_process.h"

#include <fcntl.h>
#include <signal.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "suffuse/common/error.h"
#include "suffuse/common/signal_watch.h"

namespace suffuse::analysis {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPatience = 10;  // seconds between SIGTERM and SIGKILL: `suffuse` ends its fluid step first
constexpr auto kLook = std::chrono::milliseconds(2);

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Seconds that all cores of the machine together have been busy since it started; 0 where it does not tell.
double busy_seconds() {
  std::ifstream stat("/proc/stat");
  std::string word;
  double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, interrupts = 0, soft = 0;
  if (!(stat >> word >> user >> nice >> system >> idle >> waiting >> interrupts >> soft)) return 0;
  return (user + nice + system + interrupts + soft) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// In the child: becomes the program. Returns only where it cannot.
void become(const std::vector<std::string>& words, const std::string& folder, const std::string& log) {
  setpgid(0, 0);  // so that all that it starts can be ended with it
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // if the study is killed, no run stays behind in its folder
#endif
  if (chdir(folder.c_str()) != 0) return;
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int nothing = open("/dev/null", O_RDONLY);
  if (file < 0 || nothing < 0) return;
  dup2(nothing, STDIN_FILENO);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
}

/// Starts the program; the pipe closes by itself once it has become it, and brings errno where it cannot.
pid_t start(const std::vector<std::string>& words, const std::string& folder, const std::string& log) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) return -1;
  const pid_t child = fork();
  if (child == 0) {
    become(words, folder, log);
    const int problem = errno;
    if (write(pipe_ends[1], &problem, sizeof problem) < 0) _exit(126);
    _exit(127);
  }
  close(pipe_ends[1]);
  int problem = 0;
  const bool failed = child < 0 || read(pipe_ends[0], &problem, sizeof problem) == sizeof problem;
  close(pipe_ends[0]);
  if (!failed) return child;
  if (child > 0) waitpid(child, nullptr, 0);
  throw_user_error({"suffuse-study", "program", words[0], "start", std::strerror(problem)});
}

/// Waits, and ends the child when its time is over or a signal has come.
ProcessEnd::How wait_for(pid_t child, double limit, int& status, rusage& usage) {
  const Clock::time_point begin = Clock::now();
  ProcessEnd::How how = ProcessEnd::How::exited;
  double asked = 0;
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    const double now = since(begin);
    const bool over = limit > 0 && now > limit, interrupted = SignalWatch::received() != 0;
    if (how == ProcessEnd::How::exited && (over || interrupted)) {
      how = interrupted ? ProcessEnd::How::interrupted : ProcessEnd::How::too_long;
      asked = now;
      kill(-child, SIGTERM);
    }
    if (how != ProcessEnd::How::exited && now > asked + kPatience) kill(-child, SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
  return how;
}

}  // namespace

ProcessEnd run_timed(const std::vector<std::string>& words, const std::string& folder, const std::string& log,
                     double limit) {
  const double busy_before = busy_seconds();
  const Clock::time_point begin = Clock::now();
  const pid_t child = start(words, folder, log);
  int status = 0;
  rusage usage{};
  ProcessEnd end;
  end.how = wait_for(child, limit, status, usage);
  end.wall = since(begin);
  end.core = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.other_cores = std::max(0.0, busy_seconds() - busy_before - end.core) / end.wall;
  if (end.how == ProcessEnd::How::exited && WIFSIGNALED(status)) {
    end.how = ProcessEnd::How::by_signal;
    end.code = WTERMSIG(status);
  } else if (WIFEXITED(status)) {
    end.code = WEXITSTATUS(status);
  }
  return end;
}

}  // namespace suffuse::analysis
