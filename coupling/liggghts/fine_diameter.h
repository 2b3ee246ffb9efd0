#pragma once

#include "grain_questions.h"

namespace suffuse::coupling {

/// The diameter, m, below which a quarter of the grains' surface lies: of a gap-graded bed that of its fines,
/// whatever a few lone grains have. Collective.
double fine_diameter(const GrainQuestions& questions, const GrainQuestions::Summary& grains);

}  // namespace suffuse::coupling
