#pragma once

#include "liggghts_port.h"

namespace suffuse::coupling {

/// The diameter, m, below which a quarter of the grains' surface lies: of a gap-graded bed that of its fines,
/// whatever a few lone grains have. Collective.
double fine_diameter(const LiggghtsPort& port, const LiggghtsPort::Summary& grains);

}  // namespace suffuse::coupling
