#ifdef COMMAND_CLASS

CommandStyle(say_step, SayStep)

#else

#ifndef SUFFUSE_TEST_COMMAND_SAY_STEP_H
#define SUFFUSE_TEST_COMMAND_SAY_STEP_H

#include "pointers.h"

namespace LAMMPS_NS {

/// A small command for the test of the drop-in check: prints the step.
class SayStep : protected Pointers {
 public:
  explicit SayStep(LAMMPS* lmp) : Pointers(lmp) {}
  void command(int narg, char** arg);
};

}  // namespace LAMMPS_NS

#endif
#endif
