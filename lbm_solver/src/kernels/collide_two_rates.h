#pragma once

#include "kernel_call.h"
#include "pack.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// A pack of cells before its collision, in lattice units.
template <class T>
struct CellPack {
  Pack<T> density_deviation;  ///< rho - 1 as the equilibrium sees it (zero with the incompressible one)
  Pack<T> density;            ///< rho as the equilibrium sees it
  Pack<T> velocity[3];        ///< half of the force included
  Pack<T> force[3];           ///< read only by kernels compiled with a force
};

/// c . v for a compile-time direction.
template <int Direction, class V>
[[gnu::always_inline]] inline V along(const V (&v)[3]) {
  constexpr const int* c = kVelocity[Direction];
  V sum{};
  if constexpr (c[0] == 1) sum = v[0];
  if constexpr (c[0] == -1) sum = -v[0];
  if constexpr (c[1] == 1) sum = sum + v[1];
  if constexpr (c[1] == -1) sum = sum - v[1];
  if constexpr (c[2] == 1) sum = sum + v[2];
  if constexpr (c[2] == -1) sum = sum - v[2];
  return sum;
}

/// tau under Smagorinsky's eddy viscosity, from the norm of the non-equilibrium stress Pi = sum c c (f -
/// feq): tau = (tau0 + sqrt(tau0^2 + 18 sqrt(2) C^2 |Pi| / rho)) / 2 (Hou et al. 1996; docs key: hou1996).
template <class T>
[[gnu::always_inline]] inline Pack<T> eddy_relaxation_time(const KernelCall<T>& call,
                                                           const Pack<T>& stress_squared,
                                                           const Pack<T>& density) {
  const T tau = call.relaxation_time;
  return T(0.5) *
         (tau + square_root(tau * tau + call.eddy_coefficient * square_root(stress_squared) / density));
}

/// BGK and TRT: even and odd parts of each pair of directions relax at their own rates (thesis eq 3.22 for
/// equal ones; docs key: ginzburg2008), with Guo's force term split the same way (docs key: guo2002).
template <bool kForced, bool kEddy>
struct TwoRates {
  template <class T>
  struct PairEquilibrium {
    Pack<T> even, odd;
  };

  template <int Direction, class T>
  [[gnu::always_inline]] static PairEquilibrium<T> equilibrium(const CellPack<T>& cell, const Pack<T>& u2) {
    constexpr T w = static_cast<T>(kWeight[Direction]);
    const Pack<T> cu = along<Direction>(cell.velocity);
    return {w * (cell.density_deviation + cell.density * (T(4.5) * cu * cu - u2)),
            (T(3) * w) * (cell.density * cu)};
  }

  /// Sum over all directions of Q_ab^2 with Q = sum c c (f - feq), the force's own share taken out.
  template <class T>
  [[gnu::always_inline]] static Pack<T> stress_squared(const Pack<T> (&g)[kDirections],
                                                       const CellPack<T>& cell) {
    const auto diagonal = [&](int first, int second) {
      return g[first] + g[first + 1] + g[second] + g[second + 1];
    };
    const auto shear = [&](int first, int second) {
      return g[first] + g[first + 1] - g[second] - g[second + 1];
    };
    const Pack<T> xy = diagonal(7, 9), xz = diagonal(11, 13), yz = diagonal(15, 17);
    const auto& u = cell.velocity;
    const Pack<T> third = T(1. / 3) * cell.density_deviation;
    Pack<T> normal[3] = {g[1] + g[2] + xy + xz - third - cell.density * u[0] * u[0],
                         g[3] + g[4] + xy + yz - third - cell.density * u[1] * u[1],
                         g[5] + g[6] + xz + yz - third - cell.density * u[2] * u[2]};
    Pack<T> tangential[3] = {shear(7, 9) - cell.density * u[0] * u[1],
                             shear(11, 13) - cell.density * u[0] * u[2],
                             shear(15, 17) - cell.density * u[1] * u[2]};
    if constexpr (kForced) {
      const auto& f = cell.force;
      for (int a = 0; a < 3; ++a) normal[a] = normal[a] + u[a] * f[a];
      tangential[0] = tangential[0] + T(0.5) * (u[0] * f[1] + u[1] * f[0]);
      tangential[1] = tangential[1] + T(0.5) * (u[0] * f[2] + u[2] * f[0]);
      tangential[2] = tangential[2] + T(0.5) * (u[1] * f[2] + u[2] * f[1]);
    }
    return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] +
           T(2) * (tangential[0] * tangential[0] + tangential[1] * tangential[1] +
                   tangential[2] * tangential[2]);
  }

  template <int Direction, class T>
  [[gnu::always_inline]] static void relax_pair(Pack<T> (&g)[kDirections], const CellPack<T>& cell,
                                                const Pack<T>& u2, const Pack<T>& uf,
                                                const Pack<T>& even_rate, const Pack<T>& odd_rate) {
    constexpr T w = static_cast<T>(kWeight[Direction]);
    const PairEquilibrium<T> eq = equilibrium<Direction, T>(cell, u2);
    const Pack<T> forward = g[Direction], backward = g[Direction + 1];
    Pack<T> even = even_rate * (eq.even - T(0.5) * (forward + backward));
    Pack<T> odd = odd_rate * (eq.odd - T(0.5) * (forward - backward));
    if constexpr (kForced) {
      const Pack<T> cf = along<Direction>(cell.force);
      const Pack<T> cu = along<Direction>(cell.velocity);
      even = even + (T(1) - T(0.5) * even_rate) * (w * (T(9) * cu * cf - uf));
      odd = odd + (T(1) - T(0.5) * odd_rate) * ((T(3) * w) * cf);
    }
    g[Direction] = forward + even + odd;
    g[Direction + 1] = backward + even - odd;
  }

  template <class T>
  [[gnu::always_inline]] static void collide(Pack<T> (&g)[kDirections], const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    const auto& u = cell.velocity;
    Pack<T> even_rate = broadcast<T>(call.even_rate), odd_rate = broadcast<T>(call.odd_rate);
    if constexpr (kEddy) {
      const Pack<T> tau = eddy_relaxation_time<T>(call, stress_squared<T>(g, cell), cell.density);
      even_rate = T(1) / tau;
      const Pack<T> half = tau - T(0.5);
      odd_rate = call.single_rate ? even_rate : half / (T(0.5) * half + call.magic);
    }
    const Pack<T> u2 = T(1.5) * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    Pack<T> uf{};
    if constexpr (kForced) uf = T(3) * (u[0] * cell.force[0] + u[1] * cell.force[1] + u[2] * cell.force[2]);
    constexpr T w0 = static_cast<T>(kWeight[0]);
    Pack<T> rest = even_rate * (w0 * (cell.density_deviation - cell.density * u2) - g[0]);
    if constexpr (kForced) rest = rest - (T(1) - T(0.5) * even_rate) * (w0 * uf);
    g[0] = g[0] + rest;
    relax_pair<1, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<3, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<5, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<7, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<9, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<11, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<13, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<15, T>(g, cell, u2, uf, even_rate, odd_rate);
    relax_pair<17, T>(g, cell, u2, uf, even_rate, odd_rate);
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
