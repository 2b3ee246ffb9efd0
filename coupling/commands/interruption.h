#pragma once

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

/// "SIGTERM", "SIGINT", "SIGUSR1".
std::string signal_name(int signal);

}  // namespace suffuse::coupling
