#pragma once

#include <exception>
#include <string>
#include <utility>

namespace suffuse::coupling {

/// A run has ended before its end, by a signal, by the clock or by a guard, and is saved and closed. Thrown
/// on all ranks alike; ends the script.
class Interrupted final : public std::exception {
 public:
  Interrupted(int exit_code, std::string text) : exit_code_(exit_code), text_(std::move(text)) {}
  const char* what() const noexcept override { return text_.c_str(); }
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
  std::string text_;
};

/// "SIGTERM", "SIGINT", "SIGUSR1", or what else has stopped a run (wall_limit.h).
std::string stop_name(int stop);
/// What the program ends with then (exit_codes.h).
int exit_code_of_stop(int stop);

}  // namespace suffuse::coupling
