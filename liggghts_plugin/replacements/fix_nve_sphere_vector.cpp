#include "fix_nve_sphere_vector.h"

#include <algorithm>

#include "atom.h"
#include "domain.h"

namespace LAMMPS_NS {

namespace {
constexpr int kBlock = 512;  // grains; their data stay in the first-level cache between the loops

void add_scaled(double* __restrict to, const double* __restrict factor, const double* __restrict what,
                int count) {
  for (int k = 0; k < count; ++k) to[k] += factor[k] * what[k];
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
  per_mass_.resize(3 * kBlock);
  per_inertia_.resize(3 * kBlock);
  const int owned = atom->nlocal;
  const int* mask = atom->mask;
  // Runs of grains that belong to the group: all of them, most often.
  for (int first = 0; first < owned;) {
    while (first < owned && (mask[first] & groupbit) == 0) ++first;
    int end = first;
    const int most = std::min(owned, first + kBlock);
    while (end < most && (mask[end] & groupbit) != 0) ++end;
    if (end > first) advance(first, end, moves);
    first = end;
  }
}

void FixNVESphereVector::advance(int first, int end, bool moves) {
  constexpr double kInertia = 0.4, kInertiaOfDisc = 0.5;
  const double rotation = dtf / (domain->dimension == 2 ? kInertiaOfDisc : kInertia);
  const double *mass = atom->rmass + first, *radius = atom->radius + first;
  const int count = end - first, values = 3 * count;
  double *per_mass = per_mass_.data(), *per_inertia = per_inertia_.data();
  for (int i = 0; i < count; ++i) {
    const double m = dtf / mass[i], w = rotation / (radius[i] * radius[i] * mass[i]);
    for (int d = 0; d < 3; ++d) per_mass[3 * i + d] = m, per_inertia[3 * i + d] = w;
  }
  double *x = atom->x[first], *v = atom->v[first], *w = atom->omega[first];
  add_scaled(v, per_mass, atom->f[first], values);
  if (moves)
    for (int k = 0; k < values; ++k) x[k] += dtv * v[k];
  add_scaled(w, per_inertia, atom->torque[first], values);
}

}  // namespace LAMMPS_NS
