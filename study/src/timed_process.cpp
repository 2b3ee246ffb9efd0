#include "suffuse/study/timed_process.h"

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

namespace suffuse::study {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPatience = 10;  // seconds between SIGTERM and SIGKILL: `suffuse` ends its fluid step first
constexpr auto kLook = std::chrono::milliseconds(2);

double now() {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
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
void become(const ProcessCommand& command) {
  setpgid(0, 0);  // so that all that it starts can be ended with it
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // if the study is killed, no run stays behind in its folder
#endif
  if (chdir(command.folder.c_str()) != 0) return;
  const int file = open(command.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int nothing = open("/dev/null", O_RDONLY);
  if (file < 0 || nothing < 0) return;
  dup2(nothing, STDIN_FILENO);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : command.words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
}

/// Starts the program; the pipe closes by itself once it has become it, and brings errno where it cannot.
pid_t start_process(const ProcessCommand& command) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) return -1;
  const pid_t child = fork();
  if (child == 0) {
    become(command);
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
  throw_user_error({"suffuse-study", "program", command.words[0], "start", std::strerror(problem)});
}

}  // namespace

void TimedProcesses::start(std::size_t id, const ProcessCommand& command) {
  Running one;
  one.id = id;
  one.limit = command.limit;
  one.busy_before = busy_seconds();
  one.begin = now();
  one.process = start_process(command);
  running_.push_back(one);
}

void TimedProcesses::ask_to_end(Running& one, ProcessEnd::How why) {
  if (one.how != ProcessEnd::How::exited) return;
  one.how = why;
  one.asked = now();
  kill(-one.process, SIGTERM);
}

std::optional<ProcessEnd> TimedProcesses::end_of(Running& one) {
  siginfo_t ended{};
  waitid(P_PID, static_cast<id_t>(one.process), &ended, WEXITED | WNOHANG | WNOWAIT);
  if (ended.si_pid == 0) {
    if (one.how != ProcessEnd::How::exited && now() > one.asked + kPatience) kill(-one.process, SIGKILL);
    return std::nullopt;
  }
  kill(-one.process,
       SIGKILL);  // what it may have left behind; until it is waited for its number stays its own
  int status = 0;
  rusage usage{};
  wait4(one.process, &status, 0, &usage);
  ProcessEnd end;
  end.how = one.how;
  end.wall = now() - one.begin;
  end.core = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.other_cores = std::max(0.0, busy_seconds() - one.busy_before - end.core) / end.wall;
  if (end.how == ProcessEnd::How::exited && WIFSIGNALED(status)) {
    end.how = ProcessEnd::How::by_signal;
    end.code = WTERMSIG(status);
  } else if (WIFEXITED(status)) {
    end.code = WEXITSTATUS(status);
  }
  return end;
}

std::pair<std::size_t, ProcessEnd> TimedProcesses::wait_for_one() {
  while (true) {
    for (auto one = running_.begin(); one != running_.end(); ++one) {
      if (SignalWatch::received() != 0) ask_to_end(*one, ProcessEnd::How::interrupted);
      if (one->limit > 0 && now() > one->begin + one->limit) ask_to_end(*one, ProcessEnd::How::too_long);
      const std::optional<ProcessEnd> end = end_of(*one);
      if (!end) continue;
      const std::size_t id = one->id;
      running_.erase(one);
      return {id, *end};
    }
    std::this_thread::sleep_for(kLook);
  }
}

TimedProcesses::~TimedProcesses() {
  for (Running& one : running_) ask_to_end(one, ProcessEnd::How::interrupted);
  while (!running_.empty()) wait_for_one();
}

ProcessEnd run_timed(const ProcessCommand& command) {
  TimedProcesses alone;
  alone.start(0, command);
  return alone.wait_for_one().second;
}

}  // namespace suffuse::study
