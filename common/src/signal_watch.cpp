#include "suffuse/common/signal_watch.h"

namespace suffuse {

namespace {

volatile std::sig_atomic_t received_signal = 0;

extern "C" void note_signal(int signal) {
  received_signal = signal;
}

}  // namespace

SignalWatch::SignalWatch(const std::vector<std::pair<int, Second>>& signals) {
  received_signal = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  for (const auto& [signal, second] : signals) {
    action.sa_flags = SA_RESTART;
    if (second == Second::as_usual) action.sa_flags |= static_cast<int>(SA_RESETHAND);
    sigaction(signal, &action, &before_.emplace_back(signal, action).second);
  }
}

SignalWatch::~SignalWatch() {
  for (const auto& [signal, action] : before_) sigaction(signal, &action, nullptr);
}

int SignalWatch::received() {
  return received_signal;
}

}  // namespace suffuse
