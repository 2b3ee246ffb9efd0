#include "interruption.h"

#include <fmt/format.h>

namespace suffuse::coupling {

namespace {

volatile std::sig_atomic_t received_signal = 0;

extern "C" void note_signal(int signal) {
  received_signal = signal;
}

}  // namespace

SignalWatch::SignalWatch() {
  received_signal = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  for (std::size_t n = 0; n < kSignals.size(); ++n) {
    action.sa_flags = SA_RESTART;  // writing of files goes on
    if (kSignals[n] == SIGINT) action.sa_flags |= static_cast<int>(SA_RESETHAND);
    sigaction(kSignals[n], &action, &before_[n]);
  }
}

SignalWatch::~SignalWatch() {
  for (std::size_t n = 0; n < kSignals.size(); ++n) sigaction(kSignals[n], &before_[n], nullptr);
}

int SignalWatch::received() const {
  return received_signal;
}

std::string signal_name(int signal) {
  if (signal == SIGTERM) return "SIGTERM";
  if (signal == SIGINT) return "SIGINT";
  if (signal == SIGUSR1) return "SIGUSR1";
  return fmt::format("signal {}", signal);
}

}  // namespace suffuse::coupling
