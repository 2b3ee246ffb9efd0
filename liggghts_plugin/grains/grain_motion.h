#pragma once

#include <cstddef>

#include "grains/contact_pass.h"
#include "suffuse/simd/instruction_set.h"

namespace suffuse::grains {

/// Grains one after the other as LIGGGHTS keeps them: three values each of vectors, one of the others (SI).
struct MovingGrains {
  double *position, *velocity, *spin;
  const double *force, *torque, *mass, *radius;
};

/// What a part of a step of velocity Verlet does: v += half_step F / m, then x += step v, and
/// w += half_step M / (inertia r^2 m).
struct MotionStep {
  double half_step = 0;  ///< s
  double step = 0;       ///< s; 0: positions stay as they are
  double inertia = 0.4;  ///< of a sphere; 1/2 of a disc
};

/// Advances grains 0 <= i < count. The same grain moves alike wherever it stands among the others.
void advance_grains(InstructionSet instruction_set, const MovingGrains& grains, std::size_t count,
                    const MotionStep& step);

/// Positions and motion as a contact pass reads them (see GrainArrays). `mobility`: factor of 1/m, one a
/// grain.
void gather_motion(InstructionSet instruction_set, const MovingGrains& grains, const double* mobility,
                   std::size_t count, Quad* position, Quad* velocity, Quad* spin);

/// Adds loads to `force` and `torque`, three values a grain, and leaves the loads at zero.
void hand_out_loads(InstructionSet instruction_set, Load* loads, std::size_t count, double* force,
                    double* torque);

}  // namespace suffuse::grains
