#pragma once

#include "suffuse/common/linear_algebra.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse {

/// Shrinks the periodic box about its centre for one step at these rates (1/s, compression positive), and
/// moves all grains with it.
void deform_box(LAMMPS_NS::LAMMPS* lmp, const Vec3& rate);

}  // namespace suffuse
