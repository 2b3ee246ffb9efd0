#include "fix_nve_sphere_vector.h"

#include "atom.h"
#include "domain.h"
#include "grains/grain_motion.h"

namespace LAMMPS_NS {

using suffuse::grains::advance_grains;
using suffuse::grains::MotionStep;

namespace {
/// The first grain from `first` on that is not of the group; `owned` if all are.
int end_of_run(const int* mask, int first, int owned, int group) {
  constexpr int kBlock = 64;
  int end = first;
  for (int common = group; end + kBlock <= owned; end += kBlock) {
    for (int k = 0; k < kBlock; ++k) common &= mask[end + k];
    if (common == 0) break;
  }
  while (end < owned && (mask[end] & group) != 0) ++end;
  return end;
}
}  // namespace

bool FixNVESphereVector::plain() const {
  return !useAM_ && extra == 0 && igroup != atom->firstgroup;
}

void FixNVESphereVector::initial_integrate(int vflag) {
  if (plain())
    advance_group(true);
  else
    FixNVESphere::initial_integrate(vflag);
}

void FixNVESphereVector::final_integrate() {
  if (plain())
    advance_group(false);
  else
    FixNVESphere::final_integrate();
}

void FixNVESphereVector::advance_group(bool moves) {
  constexpr double kInertiaOfDisc = 0.5;
  MotionStep step{dtf, moves ? dtv : 0};
  if (domain->dimension == 2) step.inertia = kInertiaOfDisc;
  const int owned = atom->nlocal;
  const int* mask = atom->mask;
  // Runs of grains that belong to the group: all of them, most often.
  for (int first = 0; first < owned;) {
    while (first < owned && (mask[first] & groupbit) == 0) ++first;
    const int end = end_of_run(mask, first, owned, groupbit);
    if (end > first)
      advance_grains(instruction_set_,
                     {atom->x[first], atom->v[first], atom->omega[first], atom->f[first], atom->torque[first],
                      atom->rmass + first, atom->radius + first},
                     static_cast<std::size_t>(end - first), step);
    first = end;
  }
}

}  // namespace LAMMPS_NS
