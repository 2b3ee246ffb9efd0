#include "command_say_step.h"

#include <cstdio>

#include "update.h"

void LAMMPS_NS::SayStep::command(int, char**) {
  std::printf("step %ld\n", static_cast<long>(update->ntimestep));
}
