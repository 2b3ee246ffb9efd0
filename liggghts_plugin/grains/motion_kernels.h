#pragma once

#include "grains/grain_motion.h"
#include "suffuse/simd/declare.h"

namespace suffuse::grains {

/// See grain_motion.h; one of each for every instruction set, by compiling motion_kernels.cpp for it.
#define SUFFUSE_DECLARE_MOTION(instruction_set)                                                             \
  namespace instruction_set {                                                                               \
  void advance_grains(const MovingGrains& grains, std::size_t count, const MotionStep& step);               \
  void gather_motion(const MovingGrains& grains, const double* mobility, std::size_t count, Quad* position, \
                     Quad* velocity, Quad* spin);                                                           \
  void hand_out_loads(Load* loads, std::size_t count, double* force, double* torque);                       \
  }
SUFFUSE_FOR_EACH_INSTRUCTION_SET(SUFFUSE_DECLARE_MOTION)
#undef SUFFUSE_DECLARE_MOTION

}  // namespace suffuse::grains
