#pragma once

#include "kernel_call.h"
#include "pack.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// A pack of cells before its collision, in lattice units.
template <class T>
struct CellPack {
  Pack<T> density_deviation;  ///< rho - 1
  Pack<T> density;  ///< rho; one with He & Luo's incompressible equilibrium, which differs in nothing else
  Pack<T> inverse_density;
  Pack<T> momentum[3];  ///< rho u, half of the force included
  Pack<T> velocity[3];
  Pack<T> force[3];  ///< read only by kernels compiled with a force
};

/// The populations of a pack, less their weights, held in registers (as far as they go).
template <class T>
struct HeldPopulations {
  Pack<T> values[kDirections];
  [[gnu::always_inline]] Pack<T> get(int i) const { return values[i]; }
  [[gnu::always_inline]] void put(int i, const Pack<T>& value) { values[i] = value; }
};

/// The same, left in memory: get() reads a place, put() writes the place of the opposite direction. A pair of
/// opposite directions writes the two places that it reads, so an operator may go pair by pair as long as it
/// gets both before it puts either. For instruction sets with few registers: reading twice is cheaper than
/// keeping copies on the stack.
template <class T>
struct PlacedPopulations {
  T* const* place;
  std::ptrdiff_t x;
  [[gnu::always_inline]] Pack<T> get(int i) const { return load<T>(place[i] + x); }
  [[gnu::always_inline]] void put(int i, const Pack<T>& value) const {
    store<T>(place[opposite(i)] + x, value);
  }
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
                                                           const Pack<T>& inverse_density) {
  const T tau = call.relaxation_time;
  return T(0.5) * (tau + square_root(tau * tau +
                                     call.eddy_coefficient * square_root(stress_squared) * inverse_density));
}

/// BGK and TRT: even and odd parts of each pair of directions relax at their own rates (thesis eq 3.22 for
/// equal ones; docs key: ginzburg2008), with Guo's force term split the same way (docs key: guo2002).
template <bool kForced, bool kEddy>
struct TwoRates {
  /// Sum over all directions of Q_ab^2 with Q = sum c c (f - feq), the force's own share taken out.
  template <class T, class Populations>
  [[gnu::always_inline]] static Pack<T> stress_squared(const Populations& g, const CellPack<T>& cell) {
    const auto diagonal = [&](int first, int second) {
      return (g.get(first) + g.get(first + 1)) + (g.get(second) + g.get(second + 1));
    };
    const auto shear = [&](int first, int second) {
      return (g.get(first) + g.get(first + 1)) - (g.get(second) + g.get(second + 1));
    };
    const Pack<T> xy = diagonal(7, 9), xz = diagonal(11, 13), yz = diagonal(15, 17);
    const auto &u = cell.velocity, &j = cell.momentum;
    const Pack<T> third = T(1. / 3) * cell.density_deviation;
    Pack<T> normal[3] = {(g.get(1) + g.get(2)) + (xy + xz) - third - j[0] * u[0],
                         (g.get(3) + g.get(4)) + (xy + yz) - third - j[1] * u[1],
                         (g.get(5) + g.get(6)) + (xz + yz) - third - j[2] * u[2]};
    Pack<T> tangential[3] = {shear(7, 9) - j[0] * u[1], shear(11, 13) - j[0] * u[2],
                             shear(15, 17) - j[1] * u[2]};
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

  /// What pairs of one weight share. With s and d the sum and difference of a pair, the pair after the
  /// collision is E + O and E - O with
  ///   E = keep_even s + (quadratic cu + even_force . c) cu + isotropic,
  ///   O = keep_odd d + odd cu + odd_force . c.
  template <class T>
  struct Shared {
    Pack<T> keep_even, keep_odd;          ///< (1 - rate)/2
    Pack<T> quadratic;                    ///< 9/2 w rate rho
    Pack<T> isotropic;                    ///< w (rate (rho - 1 - 3/2 rho u^2) - 3 (1 - rate/2) u.F)
    Pack<T> odd;                          ///< 3 w rate rho
    Pack<T> even_force[3], odd_force[3];  ///< 9 w (1 - rate/2) F and 3 w (1 - rate/2) F
  };

  template <int Direction, class T, class Populations>
  [[gnu::always_inline]] static void relax_pair(Populations& g, const CellPack<T>& cell,
                                                const Shared<T>& shared) {
    const Pack<T> forward = g.get(Direction), backward = g.get(Direction + 1);
    const Pack<T> sum = forward + backward, difference = forward - backward;
    const Pack<T> cu = along<Direction>(cell.velocity);
    Pack<T> slope = shared.quadratic * cu, odd = shared.odd * cu;
    if constexpr (kForced) {
      slope = slope + along<Direction>(shared.even_force);
      odd = odd + along<Direction>(shared.odd_force);
    }
    const Pack<T> even = shared.keep_even * sum + (slope * cu + shared.isotropic);
    odd = shared.keep_odd * difference + odd;
    g.put(Direction, even + odd);
    g.put(Direction + 1, even - odd);
  }

  template <class T, class Populations>
  [[gnu::always_inline]] static void collide(Populations& g, const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    const auto& u = cell.velocity;
    Pack<T> even_rate = broadcast<T>(call.even_rate), odd_rate = broadcast<T>(call.odd_rate);
    if constexpr (kEddy) {
      const Pack<T> tau = eddy_relaxation_time<T>(call, stress_squared<T>(g, cell), cell.inverse_density);
      if (call.single_rate) {
        even_rate = odd_rate = T(1) / tau;
      } else {  // 1/tau and half/(half/2 + Lambda) with one division
        const Pack<T> half = tau - T(0.5), divisor = T(0.5) * half + call.magic;
        const Pack<T> inverse = T(1) / (tau * divisor);
        even_rate = divisor * inverse;
        odd_rate = (half * tau) * inverse;
      }
    }
    const Pack<T> u2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    Pack<T> isotropic = even_rate * (cell.density_deviation - (T(1.5) * cell.density) * u2);
    Pack<T> even_force, odd_force;
    if constexpr (kForced) {
      even_force = T(1) - T(0.5) * even_rate;
      odd_force = T(1) - T(0.5) * odd_rate;
      isotropic = isotropic -
                  (T(3) * even_force) * (u[0] * cell.force[0] + u[1] * cell.force[1] + u[2] * cell.force[2]);
    }
    const auto shared_at = [&](T w) {
      Shared<T> shared;
      shared.keep_even = T(0.5) - T(0.5) * even_rate;
      shared.keep_odd = T(0.5) - T(0.5) * odd_rate;
      shared.quadratic = (T(4.5) * w * even_rate) * cell.density;
      shared.isotropic = w * isotropic;
      shared.odd = (T(3) * w * odd_rate) * cell.density;
      if constexpr (kForced)
        for (int a = 0; a < 3; ++a) {
          shared.even_force[a] = (T(9) * w * even_force) * cell.force[a];
          shared.odd_force[a] = (T(3) * w * odd_force) * cell.force[a];
        }
      return shared;
    };
    constexpr T w0 = static_cast<T>(kWeight[0]);
    g.put(0, (T(1) - even_rate) * g.get(0) + w0 * isotropic);
    const Shared<T> axes = shared_at(static_cast<T>(kWeight[1])),
                    diagonals = shared_at(static_cast<T>(kWeight[7]));
    relax_pair<1, T>(g, cell, axes);
    relax_pair<3, T>(g, cell, axes);
    relax_pair<5, T>(g, cell, axes);
    relax_pair<7, T>(g, cell, diagonals);
    relax_pair<9, T>(g, cell, diagonals);
    relax_pair<11, T>(g, cell, diagonals);
    relax_pair<13, T>(g, cell, diagonals);
    relax_pair<15, T>(g, cell, diagonals);
    relax_pair<17, T>(g, cell, diagonals);
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
