#pragma once

#include <csignal>
#include <utility>
#include <vector>

namespace suffuse {

/// Notes signals while it lives instead of dying of them, and puts the handlers back that were there. Calls
/// that one interrupts go on. One at a time.
class SignalWatch {
 public:
  /// How a second one of the same signal is taken.
  enum class Second { noted, as_usual };

  explicit SignalWatch(const std::vector<std::pair<int, Second>>& signals);
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// Number of the signal that has come to this process since the last watch began; 0: none.
  static int received();

 private:
  std::vector<std::pair<int, struct sigaction>> before_;
};

}  // namespace suffuse
