#pragma once

#include <string>

#include "grain_questions.h"

namespace suffuse::coupling {

/// Low corner and size of the fluid, m.
struct FluidBox {
  Vec3 low, size;
};

/// A block region of the script, or LIGGGHTS's box where `region` is empty. A UserError where the region is
/// none, or does not span a periodic axis.
FluidBox fluid_box(LAMMPS_NS::LAMMPS* lmp, const GrainQuestions& questions, const std::string& region);

}  // namespace suffuse::coupling
