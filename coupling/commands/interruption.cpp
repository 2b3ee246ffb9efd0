#include "interruption.h"

#include <fmt/format.h>

#include <csignal>

namespace suffuse::coupling {

std::string signal_name(int signal) {
  if (signal == SIGTERM) return "SIGTERM";
  if (signal == SIGINT) return "SIGINT";
  if (signal == SIGUSR1) return "SIGUSR1";
  return fmt::format("signal {}", signal);
}

}  // namespace suffuse::coupling
