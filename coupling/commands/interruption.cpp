#include "interruption.h"

#include <fmt/format.h>

#include <csignal>

#include "exit_codes.h"
#include "wall_limit.h"

namespace suffuse::coupling {

std::string stop_name(int stop) {
  if (stop == SIGTERM) return "SIGTERM";
  if (stop == SIGINT) return "SIGINT";
  if (stop == SIGUSR1) return "SIGUSR1";
  if (stop == kWallLimitStops) return "its wall-time limit";
  return fmt::format("signal {}", stop);
}

int exit_code_of_stop(int stop) {
  return stop == kWallLimitStops ? exit_code::time_limit : exit_code::signal + stop;
}

}  // namespace suffuse::coupling
