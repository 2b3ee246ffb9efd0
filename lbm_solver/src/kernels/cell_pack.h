#pragma once

#include "kernel_call.h"
#include "suffuse/simd/pack.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

using namespace simd::SUFFUSE_KERNEL_NAMESPACE;

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
/// gets both before it puts either. There are too few registers for 19 populations and what a collision needs
/// besides: reading twice is cheaper than keeping copies on the stack.
template <class T>
struct PlacedPopulations {
  T* const* place;
  std::ptrdiff_t x;
  int lanes;  ///< that are written
  [[gnu::always_inline]] Pack<T> get(int i) const { return load<T>(place[i] + x); }
  [[gnu::always_inline]] void put(int i, const Pack<T>& value) const {
    if (lanes == kPackWidth<T>)
      store<T>(place[opposite(i)] + x, value);
    else
      store_lanes<T>(place[opposite(i)] + x, value, lanes);
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

/// Even and odd rate of a cell whose relaxation time is tau, with one division: 1/tau and
/// half/(half/2 + Lambda), half = tau - 1/2; with a single rate 1/tau both.
template <class T>
[[gnu::always_inline]] inline void rates_under(const KernelCall<T>& call, const Pack<T>& tau,
                                               Pack<T>& even_rate, Pack<T>& odd_rate) {
  if (call.single_rate) {
    even_rate = odd_rate = T(1) / tau;
    return;
  }
  const Pack<T> half = tau - T(0.5), divisor = T(0.5) * half + call.magic;
  const Pack<T> inverse = T(1) / (tau * divisor);
  even_rate = divisor * inverse;
  odd_rate = (half * tau) * inverse;
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
