#include "servo_box.h"

#include <cmath>

#include "atom.h"
#include "domain.h"
#include "lammps.h"
#include "update.h"

namespace suffuse {

void deform_box(LAMMPS_NS::LAMMPS* lmp, const Vec3& rate) {
  if (rate.isZero()) return;
  auto* const domain = lmp->domain;
  double scale[3], centre[3];
  for (int d = 0; d < 3; ++d) {
    scale[d] = std::exp(-rate[d] * lmp->update->dt);
    centre[d] = 0.5 * (domain->boxlo[d] + domain->boxhi[d]);
    const double half = 0.5 * (domain->boxhi[d] - domain->boxlo[d]) * scale[d];
    domain->boxlo[d] = centre[d] - half;
    domain->boxhi[d] = centre[d] + half;
  }
  double** x = lmp->atom->x;
  for (int i = 0; i < lmp->atom->nlocal; ++i)
    for (int d = 0; d < 3; ++d) x[i][d] = centre[d] + (x[i][d] - centre[d]) * scale[d];
  domain->set_global_box();
  domain->set_local_box();
}

}  // namespace suffuse
