#pragma once

#include "moments_to_populations.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// k_aabb = rho/9.
struct FourthAtEquilibrium {
  template <class T>
  [[gnu::always_inline]] static Pack<T> fourth(const CellPack<T>& cell, const Pack<T>&, const Pack<T>&,
                                               const Pack<T>&) {
    return T(1. / 36) * cell.density_deviation;
  }
};

/// Relaxation of moments about the local velocity (docs key: derosis2019): the deviatoric stress at the
/// viscosity's rate, everything else (the trace and the moments of third and fourth order) set to its
/// equilibrium.
///
/// What is set to its equilibrium need not be known before: density, momentum and the six second moments go
/// in, and all 19 populations are made anew from the moments after the collision. With k for central and M
/// for raw moments, F the force and W = M whole (not only its deviation from the weights'), in a plane of
/// axes (a, b) whose velocities are u and v:
///   k_ab  relaxed,  k_abb = F_a/6 (the source F_a/3 times 1 - rate/2, at rate 1),  k_aabb = rho/9,
///   M_ab   = k_ab + rho u v + (u F_b + v F_a)/2
///   M_abb  = k_abb + 2 v k_ab + u W_bb + v^2 F_a/2
///   M_aabb = k_aabb + u (M_abb + k_abb) + v (M_aab + k_aab) - u v (M_ab - k_ab).
/// Only deviations and products with velocities are ever summed: float storage keeps its small velocities.
/// D3Q19 has no c_x c_y c_z.
///
/// Closure::fourth gives a quarter of k_aabb of a plane, less the weights', from the second central moments
/// after the collision: what the normal ones are beyond rho/3, and the shear.
template <bool kForced, bool kEddy, class Closure = FourthAtEquilibrium>
struct CentralMoments {
  static constexpr bool kKeepsSums = false;

  /// What every plane needs: raw second moments after the collision, whole.
  template <class T>
  struct Relaxed {
    Pack<T> whole[3];         ///< W_aa
    Pack<T> beyond[3];        ///< k_aa - rho/3
    Pack<T> quarter_u[3];     ///< u/4
    Pack<T> third_source[3];  ///< a quarter of k_abb; only with a force
  };

  /// Makes the four populations of plane (a, b), see put_plane. `shear` is k_ab after the collision, `shift`
  /// what M_ab has besides.
  template <class T, class Populations>
  [[gnu::always_inline]] static PlaneMoments<T> make_plane(Populations& g, int first, int second, int a,
                                                           int b, const CellPack<T>& cell,
                                                           const Relaxed<T>& relaxed, const Pack<T>& shear,
                                                           const Pack<T>& shift) {
    using V = Pack<T>;
    const V &u = cell.velocity[a], &v = cell.velocity[b];
    const V &qu = relaxed.quarter_u[a], &qv = relaxed.quarter_u[b];
    const V twice = T(2) * shear;
    const V fourth = Closure::template fourth<T>(cell, relaxed.beyond[a], relaxed.beyond[b], shear);
    PlaneMoments<T> m;
    m.third_a = qu * relaxed.whole[b] + qv * twice;
    m.third_b = qv * relaxed.whole[a] + qu * twice;
    if constexpr (kForced) {
      m.third_a = m.third_a + ((T(0.5) * v) * qv * cell.force[a] + relaxed.third_source[a]);
      m.third_b = m.third_b + ((T(0.5) * u) * qu * cell.force[b] + relaxed.third_source[b]);
      m.fourth = (u * (m.third_a + relaxed.third_source[a]) + fourth) +
                 (v * (m.third_b + relaxed.third_source[b]) - (qu * v) * shift);
    } else {
      m.fourth = (u * m.third_a + fourth) + (v * m.third_b - (qu * v) * shift);
    }
    const V second_moment = T(0.25) * (shear + shift);
    put_plane<T>(g, first, second, m, second_moment);
    return m;
  }

  template <class T, class Populations>
  [[gnu::always_inline]] static void collide(Populations& g, const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    using V = Pack<T>;
    const auto sum = [&](int pair) { return g.get(pair) + g.get(pair + 1); };
    const auto &u = cell.velocity, &j = cell.momentum;
    const V xy = sum(7) + sum(9), xz = sum(11) + sum(13), yz = sum(15) + sum(17);
    const V third = T(1. / 3) * cell.density_deviation;
    // Raw second moments before the collision, and what of them is not central.
    V normal[3] = {sum(1) + (xy + xz), sum(3) + (xy + yz), sum(5) + (xz + yz)};
    V shear[3] = {sum(7) - sum(9), sum(11) - sum(13), sum(15) - sum(17)};
    V normal_shift[3] = {j[0] * u[0], j[1] * u[1], j[2] * u[2]};
    V shift[3] = {j[0] * u[1], j[0] * u[2], j[1] * u[2]};
    if constexpr (kForced) {
      // The shifts with the force as it stands after the collision; before it has the opposite sign.
      const auto& f = cell.force;
      const V work[3] = {u[0] * f[0], u[1] * f[1], u[2] * f[2]};
      const V turn[3] = {T(0.5) * (u[0] * f[1] + u[1] * f[0]), T(0.5) * (u[0] * f[2] + u[2] * f[0]),
                         T(0.5) * (u[1] * f[2] + u[2] * f[1])};
      for (int a = 0; a < 3; ++a) {
        normal[a] = normal[a] - (normal_shift[a] - work[a]);
        shear[a] = shear[a] - (shift[a] - turn[a]);
        normal_shift[a] = normal_shift[a] + work[a];
        shift[a] = shift[a] + turn[a];
      }
    } else {
      for (int a = 0; a < 3; ++a) {
        normal[a] = normal[a] - normal_shift[a];
        shear[a] = shear[a] - shift[a];
      }
    }
    V keep = broadcast<T>(T(1) - call.even_rate);
    if constexpr (kEddy) {
      const V x = normal[0] - third, y = normal[1] - third, z = normal[2] - third;
      const V squared =
          x * x + y * y + z * z + T(2) * (shear[0] * shear[0] + shear[1] * shear[1] + shear[2] * shear[2]);
      keep = T(1) - T(1) / eddy_relaxation_time<T>(call, squared, cell.inverse_density);
    }
    const V mean = T(1. / 3) * (normal[0] + normal[1] + normal[2]);
    const V base = T(1. / 3) * (cell.density - cell.density_deviation);
    Relaxed<T> relaxed;
    for (int a = 0; a < 3; ++a) {
      relaxed.beyond[a] = keep * (normal[a] - mean);
      normal[a] = relaxed.beyond[a] + (normal_shift[a] + third);
      shear[a] = keep * shear[a];
      relaxed.whole[a] = base + normal[a];
      relaxed.quarter_u[a] = T(0.25) * u[a];
      if constexpr (kForced) relaxed.third_source[a] = T(1. / 24) * cell.force[a];
    }
    const auto in_xy = make_plane<T>(g, 7, 9, 0, 1, cell, relaxed, shear[0], shift[0]);
    const auto in_xz = make_plane<T>(g, 11, 13, 0, 2, cell, relaxed, shear[1], shift[1]);
    const auto in_yz = make_plane<T>(g, 15, 17, 1, 2, cell, relaxed, shear[2], shift[2]);
    put_axes_and_rest<kForced, T>(g, cell, normal, in_xy, in_xz, in_yz);
  }
};

namespace central_moments {
template <bool kForced, bool kEddy>
using Law = CentralMoments<kForced, kEddy>;
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
