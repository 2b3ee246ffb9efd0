#pragma once

#include "cell_pack.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// Q = sum c c (f - feq), the force's own share taken out; tangential: xy, xz, yz.
template <class T>
struct Stress {
  Pack<T> normal[3], tangential[3];
};
template <bool kForced, class T, class Populations>
[[gnu::always_inline]] inline Stress<T> stress_of(const Populations& g, const CellPack<T>& cell) {
  const auto diagonal = [&](int first, int second) {
    return (g.get(first) + g.get(first + 1)) + (g.get(second) + g.get(second + 1));
  };
  const auto shear = [&](int first, int second) {
    return (g.get(first) + g.get(first + 1)) - (g.get(second) + g.get(second + 1));
  };
  const Pack<T> xy = diagonal(7, 9), xz = diagonal(11, 13), yz = diagonal(15, 17);
  const auto &u = cell.velocity, &j = cell.momentum;
  const Pack<T> third = T(1. / 3) * cell.density_deviation;
  Stress<T> stress{{(g.get(1) + g.get(2)) + (xy + xz) - third - j[0] * u[0],
                    (g.get(3) + g.get(4)) + (xy + yz) - third - j[1] * u[1],
                    (g.get(5) + g.get(6)) + (xz + yz) - third - j[2] * u[2]},
                   {shear(7, 9) - j[0] * u[1], shear(11, 13) - j[0] * u[2], shear(15, 17) - j[1] * u[2]}};
  if constexpr (kForced) {
    const auto& f = cell.force;
    auto &normal = stress.normal, &tangential = stress.tangential;
    for (int a = 0; a < 3; ++a) normal[a] = normal[a] + u[a] * f[a];
    tangential[0] = tangential[0] + T(0.5) * (u[0] * f[1] + u[1] * f[0]);
    tangential[1] = tangential[1] + T(0.5) * (u[0] * f[2] + u[2] * f[0]);
    tangential[2] = tangential[2] + T(0.5) * (u[1] * f[2] + u[2] * f[1]);
  }
  return stress;
}

/// Sum over all directions of Q_ab^2.
template <class T>
[[gnu::always_inline]] inline Pack<T> squared(const Stress<T>& stress) {
  const auto &normal = stress.normal, &tangential = stress.tangential;
  return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] +
         T(2) *
             (tangential[0] * tangential[0] + tangential[1] * tangential[1] + tangential[2] * tangential[2]);
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
