#pragma once

#include "moments_to_populations.h"
#include "stress.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// TRT about the local velocity (docs/decisions/solid-operator.md): even central moments relax at the even
/// rate, those of third order at the odd one.
///
/// The equilibrium is thesis eq 3.25's but for the fourth moments, rho (1/9 + (u_a^2 + u_b^2)/3) here,
/// without the -u_c^2/6 by which D3Q19 is not the same in all frames; Guo's source (docs key: guo2002) goes
/// with it: its fourth moments are 2/3 (u_a F_a + u_b F_b). With Q the second moments about the velocity of
/// what is out of equilibrium, and T = M_abb - (j_a - F_a/2)/3 the third ones of the lattice's frame, the
/// moment about the velocity is K = T - 2 u_b Q_ab - u_a Q_bb, and after the collision, with d = even - odd
/// rate:
///   M_ab   = rho u_a u_b + (u_a F_b + u_b F_a)/2 + (1 - even) Q_ab
///   M_abb  = (j_a + F_a/2)/3 + (1 - even) T + d K
///   M_aabb = (1 - even) M_aabb + even equilibrium + (1 - even/2) source + 2 d (u_a K_abb + u_b K_aab).
/// Made in this way from the 19 moments it takes three quarters of the arithmetic of TRT with changes added
/// pair by pair.
template <bool kForced, bool kEddy>
struct ComovingRates {
  static constexpr bool kKeepsSums = true;

  /// What the planes share; thirds and quarters are multiplied in.
  template <class T>
  struct Shared {
    Pack<T> flow[3];     ///< (j - F/2)/3, a third of the momentum without the force
    Pack<T> third[3];    ///< ((j - F/2) + F)/12: a quarter of M_abb's equilibrium and source
    Pack<T> normal[3];   ///< d/4 Q_aa
    Pack<T> fourth[3];   ///< an axis's half of a quarter of M_aabb's equilibrium and source
    Pack<T> twice_u[3];  ///< 2 u
    Pack<T> keep;        ///< (1 - even)/4
    Pack<T> difference;  ///< d/4
  };

  template <class T>
  [[gnu::always_inline]] static PlaneMoments<T> relax_plane(const CellPack<T>& cell, const Shared<T>& shared,
                                                            int a, int b, const Pack<T>& third_a,
                                                            const Pack<T>& third_b, const Pack<T>& fourth,
                                                            const Pack<T>& shear) {
    using V = Pack<T>;
    const V &u = cell.velocity[a], &v = cell.velocity[b], &uu = shared.twice_u[a], &vv = shared.twice_u[b];
    const V shear_change = shared.difference * shear;
    const V away_a = third_a - shared.flow[a], away_b = third_b - shared.flow[b];
    const V change_a = (shared.difference * away_a - shear_change * vv) - shared.normal[b] * u;
    const V change_b = (shared.difference * away_b - shear_change * uu) - shared.normal[a] * v;
    PlaneMoments<T> m;
    m.third_a = shared.keep * away_a + (shared.third[a] + change_a);
    m.third_b = shared.keep * away_b + (shared.third[b] + change_b);
    m.fourth =
        (shared.keep * fourth + (shared.fourth[a] + shared.fourth[b])) + (uu * change_a + vv * change_b);
    return m;
  }

  template <class T, class Populations>
  [[gnu::always_inline]] static void collide(Populations& g, const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    using V = Pack<T>;
    const auto &u = cell.velocity, &j = cell.momentum;
    const Stress<T> away = stress_of<kForced, T>(g, cell);
    V even_rate = broadcast<T>(call.even_rate), odd_rate = broadcast<T>(call.odd_rate);
    if constexpr (kEddy)
      rates_under<T>(call, eddy_relaxation_time<T>(call, squared<T>(away), cell.inverse_density), even_rate,
                     odd_rate);
    // Of second moments, what the equilibrium and half of the source have beyond rho/3.
    V flow_normal[3] = {j[0] * u[0], j[1] * u[1], j[2] * u[2]};
    V flow_shear[3] = {j[0] * u[1], j[0] * u[2], j[1] * u[2]};
    const V third_of_density = T(1. / 3) * cell.density_deviation;
    V work[3];
    if constexpr (kForced) {
      const auto& f = cell.force;
      for (int a = 0; a < 3; ++a) work[a] = u[a] * f[a];
      flow_shear[0] = flow_shear[0] + T(0.5) * (u[0] * f[1] + u[1] * f[0]);
      flow_shear[1] = flow_shear[1] + T(0.5) * (u[0] * f[2] + u[2] * f[0]);
      flow_shear[2] = flow_shear[2] + T(0.5) * (u[1] * f[2] + u[2] * f[1]);
    }
    const V keep = T(1) - even_rate;
    Shared<T> shared;
    V normal[3];  // after the collision
    shared.keep = T(0.25) * keep;
    shared.difference = T(0.25) * (even_rate - odd_rate);
    const V fourth_flow = T(1. / 12) * even_rate, fourth_work = T(1. / 6) - T(1. / 12) * even_rate;
    const V fourth_at_rest = T(0.5) * (fourth_flow * third_of_density);  // even (rho - 1)/72
    for (int a = 0; a < 3; ++a) {
      shared.flow[a] = T(1. / 3) * j[a];
      if constexpr (kForced) shared.flow[a] = shared.flow[a] - T(1. / 6) * cell.force[a];
      shared.third[a] = T(0.25) * shared.flow[a];
      if constexpr (kForced) shared.third[a] = shared.third[a] + T(1. / 12) * cell.force[a];
      shared.twice_u[a] = u[a] + u[a];
      shared.fourth[a] = fourth_flow * flow_normal[a] + fourth_at_rest;
      if constexpr (kForced) shared.fourth[a] = shared.fourth[a] + fourth_work * work[a];
      shared.normal[a] = shared.difference * away.normal[a];
      normal[a] = keep * away.normal[a] + (third_of_density + flow_normal[a]);
      if constexpr (kForced) normal[a] = normal[a] + work[a];
    }
    // All planes are read before the first is written.
    PlaneMoments<T> after[3];
    for (int plane = 0; plane < 3; ++plane) {
      const int a = plane == 2 ? 1 : 0, b = plane == 0 ? 1 : 2, first = 7 + 4 * plane, second = first + 2;
      const V difference = g.get(first) - g.get(first + 1), across = g.get(second) - g.get(second + 1);
      const V fourth = (g.get(first) + g.get(first + 1)) + (g.get(second) + g.get(second + 1));
      after[plane] = relax_plane<T>(cell, shared, a, b, difference + across, difference - across, fourth,
                                    away.tangential[plane]);
    }
    for (int plane = 0; plane < 3; ++plane)
      put_plane<T>(g, 7 + 4 * plane, 9 + 4 * plane, after[plane],
                   shared.keep * away.tangential[plane] + T(0.25) * flow_shear[plane]);
    put_axes_and_rest<kForced, T>(g, cell, normal, after[0], after[1], after[2]);
  }
};

namespace comoving_rates {
template <bool kForced, bool kEddy>
using Law = ComovingRates<kForced, kEddy>;
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
