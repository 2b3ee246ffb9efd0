#pragma once

#include "stress.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// BGK and TRT: even and odd parts of each pair of directions relax at their own rates (thesis eq 3.22 for
/// equal ones; docs key: ginzburg2008), with Guo's force term split the same way (docs key: guo2002).
template <bool kForced, bool kEddy>
struct TwoRates {
  static constexpr bool kKeepsSums = false;

  /// What pairs of one weight share. With s and d the sum and difference of a pair, the pair after the
  /// collision is E + O and E - O with
  ///   E = keep_even s + (slope . c) (u . c) + isotropic,
  ///   O = keep_odd d + odd . c.
  template <class T>
  struct Shared {
    Pack<T> slope[3];   ///< 9/2 w (rate rho u + (2 - rate) F)
    Pack<T> odd[3];     ///< 3 w (rate rho u + (1 - rate/2) F)
    Pack<T> isotropic;  ///< w (rate (rho - 1 - 3/2 rho u^2) - 3 (1 - rate/2) u.F)
  };

  template <int Direction, class T, class Populations>
  [[gnu::always_inline]] static void relax_pair(Populations& g, const CellPack<T>& cell,
                                                const Pack<T>& keep_even, const Pack<T>& keep_odd,
                                                const Shared<T>& shared) {
    const Pack<T> forward = g.get(Direction), backward = g.get(Direction + 1);
    const Pack<T> sum = forward + backward, difference = forward - backward;
    const Pack<T> cu = along<Direction>(cell.velocity), slope = along<Direction>(shared.slope);
    const Pack<T> even = keep_even * sum + (slope * cu + shared.isotropic);
    const Pack<T> odd = keep_odd * difference + along<Direction>(shared.odd);
    g.put(Direction, even + odd);
    g.put(Direction + 1, even - odd);
  }

  template <class T, class Populations>
  [[gnu::always_inline]] static void collide(Populations& g, const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    const auto& u = cell.velocity;
    Pack<T> even_rate = broadcast<T>(call.even_rate), odd_rate = broadcast<T>(call.odd_rate);
    if constexpr (kEddy) {
      const Pack<T> squared_stress = squared<T>(stress_of<kForced, T>(g, cell));
      rates_under<T>(call, eddy_relaxation_time<T>(call, squared_stress, cell.inverse_density), even_rate,
                     odd_rate);
    }
    const Pack<T> u2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    Pack<T> isotropic = even_rate * (cell.density_deviation - (T(1.5) * cell.density) * u2);
    constexpr T w0 = static_cast<T>(kWeight[0]), w1 = static_cast<T>(kWeight[1]);
    Shared<T> axes, diagonals;
    const Pack<T> even_flow = (T(4.5) * w1 * even_rate) * cell.density,
                  odd_flow = (T(3) * w1 * odd_rate) * cell.density;
    for (int a = 0; a < 3; ++a) {
      axes.slope[a] = even_flow * u[a];
      axes.odd[a] = odd_flow * u[a];
    }
    if constexpr (kForced) {
      const auto& f = cell.force;
      const Pack<T> even_force = T(1) - T(0.5) * even_rate, odd_force = T(1) - T(0.5) * odd_rate;
      isotropic = isotropic - (T(3) * even_force) * (u[0] * f[0] + u[1] * f[1] + u[2] * f[2]);
      for (int a = 0; a < 3; ++a) {
        axes.slope[a] = axes.slope[a] + (T(9) * w1 * even_force) * f[a];
        axes.odd[a] = axes.odd[a] + (T(3) * w1 * odd_force) * f[a];
      }
    }
    axes.isotropic = w1 * isotropic;
    diagonals.isotropic = T(0.5) * axes.isotropic;  // whose weight is half of the axes'
    for (int a = 0; a < 3; ++a) {
      diagonals.slope[a] = T(0.5) * axes.slope[a];
      diagonals.odd[a] = T(0.5) * axes.odd[a];
    }
    const Pack<T> keep_even = T(0.5) - T(0.5) * even_rate, keep_odd = T(0.5) - T(0.5) * odd_rate;
    g.put(0, (T(1) - even_rate) * g.get(0) + w0 * isotropic);
    relax_pair<1, T>(g, cell, keep_even, keep_odd, axes);
    relax_pair<3, T>(g, cell, keep_even, keep_odd, axes);
    relax_pair<5, T>(g, cell, keep_even, keep_odd, axes);
    relax_pair<7, T>(g, cell, keep_even, keep_odd, diagonals);
    relax_pair<9, T>(g, cell, keep_even, keep_odd, diagonals);
    relax_pair<11, T>(g, cell, keep_even, keep_odd, diagonals);
    relax_pair<13, T>(g, cell, keep_even, keep_odd, diagonals);
    relax_pair<15, T>(g, cell, keep_even, keep_odd, diagonals);
    relax_pair<17, T>(g, cell, keep_even, keep_odd, diagonals);
  }
};

namespace two_rates {
template <bool kForced, bool kEddy>
using Law = TwoRates<kForced, kEddy>;
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
