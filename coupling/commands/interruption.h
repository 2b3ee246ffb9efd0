#pragma once

#include <array>
#include <csignal>
#include <exception>
#include <string>
#include <utility>

namespace suffuse::coupling {

/// A signal has ended a run, which is saved and closed. Thrown on all ranks alike; ends the script.
class Interrupted final : public std::exception {
 public:
  Interrupted(int signal, std::string text) : signal_(signal), text_(std::move(text)) {}
  const char* what() const noexcept override { return text_.c_str(); }
  /// 128 and the signal's number, as shells have it.
  int exit_code() const { return 128 + signal_; }

 private:
  int signal_;
  std::string text_;
};

/// Notes SIGTERM, SIGINT and SIGUSR1 while it lives instead of dying of them, and puts the handlers back that
/// were there. A second SIGINT acts as usual: whoever waits at a terminal can end the program at once.
/// SIGUSR1 is what mpirun passes on without killing its programs a second later.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// Number of the signal that has come to this rank; 0: none.
  int received() const;

 private:
  static constexpr std::array<int, 3> kSignals{SIGTERM, SIGUSR1, SIGINT};
  std::array<struct sigaction, kSignals.size()> before_;
};

/// "SIGTERM", "SIGINT", "SIGUSR1".
std::string signal_name(int signal);

}  // namespace suffuse::coupling
