#pragma once

#include "kernel_call.h"
#include "pack.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// A pack of cells before its collision, in lattice units.
template <class T>
struct CellPack {
  Pack<T> density_deviation;  ///< rho - 1
  Pack<T> density;  ///< rho; one with He & Luo's incompressible equilibrium, which differs in nothing else
  Pack<T> velocity[3];  ///< half of the force included
  Pack<T> force[3];     ///< read only by kernels compiled with a force
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

  /// What all pairs share. With s and d the sum and difference of a pair, the pair after the collision is E +
  /// O and E - O with E = keep_even s + ..., O = keep_odd d + ...
  template <class T>
  struct Shared {
    Pack<T> even_rate, odd_rate, keep_even, keep_odd;
    Pack<T> isotropic;              ///< rho - 1 - 3/2 rho u^2
    Pack<T> quadratic;              ///< 9/2 rho
    Pack<T> even_force, odd_force;  ///< 1 - rate/2
    Pack<T> velocity_force;         ///< 3 u.F
  };

  template <int Direction, class T>
  [[gnu::always_inline]] static void relax_pair(Pack<T> (&g)[kDirections], const CellPack<T>& cell,
                                                const Shared<T>& shared) {
    constexpr T w = static_cast<T>(kWeight[Direction]);
    const Pack<T> sum = g[Direction] + g[Direction + 1], difference = g[Direction] - g[Direction + 1];
    const Pack<T> cu = along<Direction>(cell.velocity);
    Pack<T> even =
        shared.keep_even * sum + (w * shared.even_rate) * ((shared.quadratic * cu) * cu + shared.isotropic);
    Pack<T> odd = shared.keep_odd * difference + ((T(3) * w) * shared.odd_rate) * (cell.density * cu);
    if constexpr (kForced) {
      const Pack<T> cf = along<Direction>(cell.force);
      even = even + (w * shared.even_force) * ((T(9) * cu) * cf - shared.velocity_force);
      odd = odd + ((T(3) * w) * shared.odd_force) * cf;
    }
    g[Direction] = even + odd;
    g[Direction + 1] = even - odd;
  }

  template <class T>
  [[gnu::always_inline]] static void collide(Pack<T> (&g)[kDirections], const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    const auto& u = cell.velocity;
    Shared<T> shared;
    shared.even_rate = broadcast<T>(call.even_rate);
    shared.odd_rate = broadcast<T>(call.odd_rate);
    if constexpr (kEddy) {
      const Pack<T> tau = eddy_relaxation_time<T>(call, stress_squared<T>(g, cell), cell.density);
      shared.even_rate = T(1) / tau;
      const Pack<T> half = tau - T(0.5);
      shared.odd_rate = call.single_rate ? shared.even_rate : half / (T(0.5) * half + call.magic);
    }
    shared.keep_even = T(0.5) - T(0.5) * shared.even_rate;
    shared.keep_odd = T(0.5) - T(0.5) * shared.odd_rate;
    const Pack<T> u2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    shared.quadratic = T(4.5) * cell.density;
    shared.isotropic = cell.density_deviation - (T(1.5) * cell.density) * u2;
    constexpr T w0 = static_cast<T>(kWeight[0]);
    g[0] = (T(1) - shared.even_rate) * g[0] + (w0 * shared.even_rate) * shared.isotropic;
    if constexpr (kForced) {
      shared.even_force = T(1) - T(0.5) * shared.even_rate;
      shared.odd_force = T(1) - T(0.5) * shared.odd_rate;
      shared.velocity_force = T(3) * (u[0] * cell.force[0] + u[1] * cell.force[1] + u[2] * cell.force[2]);
      g[0] = g[0] - (w0 * shared.even_force) * shared.velocity_force;
    }
    relax_pair<1, T>(g, cell, shared);
    relax_pair<3, T>(g, cell, shared);
    relax_pair<5, T>(g, cell, shared);
    relax_pair<7, T>(g, cell, shared);
    relax_pair<9, T>(g, cell, shared);
    relax_pair<11, T>(g, cell, shared);
    relax_pair<13, T>(g, cell, shared);
    relax_pair<15, T>(g, cell, shared);
    relax_pair<17, T>(g, cell, shared);
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
