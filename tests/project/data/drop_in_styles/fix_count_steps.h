#ifdef FIX_CLASS

FixStyle(count/steps, FixCountSteps)

#else

#ifndef SUFFUSE_TEST_FIX_COUNT_STEPS_H
#define SUFFUSE_TEST_FIX_COUNT_STEPS_H

#include "fix.h"

namespace LAMMPS_NS {

/// A small fix for the test of the drop-in check: f_ID is the number of steps since it was made.
class FixCountSteps : public Fix {
 public:
  FixCountSteps(LAMMPS* lmp, int narg, char** arg);
  int setmask() override;
  void end_of_step() override { ++steps_; }
  double compute_scalar() override { return steps_; }

 private:
  int steps_ = 0;
};

}  // namespace LAMMPS_NS

#endif
#endif
