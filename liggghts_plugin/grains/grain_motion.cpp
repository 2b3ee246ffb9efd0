#include "grains/grain_motion.h"

#include "grains/motion_kernels.h"
#include "suffuse/simd/dispatch.h"

namespace suffuse::grains {

void advance_grains(InstructionSet instruction_set, const MovingGrains& grains, std::size_t count,
                    const MotionStep& step) {
  const auto advance = SUFFUSE_CHOOSE(instruction_set, decltype(&portable::advance_grains), advance_grains);
  advance(grains, count, step);
}

void gather_motion(InstructionSet instruction_set, const MovingGrains& grains, const double* mobility,
                   std::size_t count, Quad* position, Quad* velocity, Quad* spin) {
  const auto gather = SUFFUSE_CHOOSE(instruction_set, decltype(&portable::gather_motion), gather_motion);
  gather(grains, mobility, count, position, velocity, spin);
}

void hand_out_loads(InstructionSet instruction_set, Load* loads, std::size_t count, double* force,
                    double* torque) {
  const auto hand_out = SUFFUSE_CHOOSE(instruction_set, decltype(&portable::hand_out_loads), hand_out_loads);
  hand_out(loads, count, force, torque);
}

}  // namespace suffuse::grains
