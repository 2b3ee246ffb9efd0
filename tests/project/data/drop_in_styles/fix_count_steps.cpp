#include "fix_count_steps.h"

#include "suffuse/common/error.h"

using namespace LAMMPS_NS;

FixCountSteps::FixCountSteps(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg > 3) suffuse::throw_user_error({"fix count/steps", "word", arg[3], "not be given", "remove it"});
  scalar_flag = 1;
  global_freq = 1;
}

int FixCountSteps::setmask() {
  return FixConst::END_OF_STEP;
}
