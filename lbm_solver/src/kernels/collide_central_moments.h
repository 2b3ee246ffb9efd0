#pragma once

#include "collide_two_rates.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// Relaxation of moments about the local velocity (docs key: derosis2019): the deviatoric stress at the
/// viscosity's rate, everything else (the trace and the moments of third and fourth order) set to its
/// equilibrium.
///
/// Written as changes of central moments, turned into changes of raw moments and then of populations, so that
/// nothing but deviations is ever summed: float storage keeps its small velocities.
///
/// Notation: second[a] is the moment c_a c_a, shear of the pairs (xy, xz, yz). For each pair of axes (a, b):
/// third_a means c_a c_b^2, third_b means c_a^2 c_b, fourth means c_a^2 c_b^2. D3Q19 has no c_x c_y c_z.
template <bool kForced, bool kEddy>
struct CentralMoments {
  /// Raw moments of one pair of axes; the directions `first` = (+,+) and `second` = (+,-) with their
  /// opposites.
  template <class V>
  struct PlaneMoments {
    V shear, third_a, third_b, fourth;
  };

  template <class V>
  [[gnu::always_inline]] static PlaneMoments<V> plane_moments(const V (&g)[kDirections], int first,
                                                              int second) {
    const V sum_first = g[first] + g[first + 1], sum_second = g[second] + g[second + 1];
    const V difference_first = g[first] - g[first + 1], difference_second = g[second] - g[second + 1];
    return {sum_first - sum_second, difference_first + difference_second,
            difference_first - difference_second, sum_first + sum_second};
  }

  /// Adds changes of raw moments to the four diagonal populations of a plane.
  template <class T>
  [[gnu::always_inline]] static void add_to_plane(Pack<T> (&g)[kDirections], int first, int second,
                                                  const PlaneMoments<Pack<T>>& change) {
    const Pack<T> plus = T(0.25) * (change.fourth + change.shear),
                  minus = T(0.25) * (change.fourth - change.shear);
    const Pack<T> sum = T(0.25) * (change.third_a + change.third_b);
    const Pack<T> difference = T(0.25) * (change.third_a - change.third_b);
    g[first] = g[first] + plus + sum;
    g[first + 1] = g[first + 1] + plus - sum;
    g[second] = g[second] + minus + difference;
    g[second + 1] = g[second + 1] + minus - difference;
  }

  /// Changes of the raw moments of a plane (a, b), whose second-order central changes are given: third and
  /// fourth central moments go to their equilibria 0 and rho/9.
  template <class T>
  [[gnu::always_inline]] static PlaneMoments<Pack<T>> plane_change(
      const PlaneMoments<Pack<T>>& m, const CellPack<T>& cell, int a, int b, const Pack<T>& second_a,
      const Pack<T>& second_b, const Pack<T>& change_a, const Pack<T>& change_b, const Pack<T>& change_ab) {
    using V = Pack<T>;
    const V& u = cell.velocity[a];
    const V& v = cell.velocity[b];
    const V uu = u * u, vv = v * v, uv = u * v;
    V ja = cell.density * u, jb = cell.density * v;
    if constexpr (kForced) {
      ja = ja - T(0.5) * cell.force[a];
      jb = jb - T(0.5) * cell.force[b];
    }
    // Whole second moments: the weights' (1/3 of the density) and the deviation from it.
    const V maa = T(1. / 3) * (cell.density - cell.density_deviation) + second_a;
    const V mbb = T(1. / 3) * (cell.density - cell.density_deviation) + second_b;
    const V central_a =
        m.third_a - T(2) * v * m.shear + vv * ja - u * mbb + T(2) * uv * jb - u * vv * cell.density;
    const V central_b =
        m.third_b - T(2) * u * m.shear + uu * jb - v * maa + T(2) * uv * ja - v * uu * cell.density;
    // sum f (c_a - u)^2 (c_b - v)^2 - rho/9; the weights' own fourth moment, 1/9, is taken out of both.
    const V central_four = m.fourth - T(1. / 9) * cell.density_deviation - T(2) * v * m.third_b -
                           T(2) * u * m.third_a + vv * maa + uu * mbb + T(4) * uv * m.shear -
                           T(2) * uv * (v * ja + u * jb) + uu * vv * cell.density;
    V change_third_a = -central_a, change_third_b = -central_b, change_four = -central_four;
    PlaneMoments<V> change;
    if constexpr (kForced) {
      const V fa = cell.force[a], fb = cell.force[b];
      change_third_a = change_third_a + T(1. / 6) * fa;  // (1 - rate/2) of the source F/3, at rate 1
      change_third_b = change_third_b + T(1. / 6) * fb;
      change.shear = change_ab + u * fb + v * fa;
      change.third_a = change_third_a + T(2) * v * change_ab + u * change_b + vv * fa + T(2) * uv * fb;
      change.third_b = change_third_b + T(2) * u * change_ab + v * change_a + uu * fb + T(2) * uv * fa;
      change_four = change_four + T(2) * uv * (v * fa + u * fb);
    } else {
      change.shear = change_ab;
      change.third_a = change_third_a + T(2) * v * change_ab + u * change_b;
      change.third_b = change_third_b + T(2) * u * change_ab + v * change_a;
    }
    change.fourth = change_four + T(2) * v * change_third_b + T(2) * u * change_third_a + vv * change_a +
                    uu * change_b + T(4) * uv * change_ab;
    return change;
  }

  template <class T>
  [[gnu::always_inline]] static void collide(Pack<T> (&g)[kDirections], const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    using V = Pack<T>;
    const auto& u = cell.velocity;
    const V& rho = cell.density;
    const PlaneMoments<V> xy = plane_moments<V>(g, 7, 9), xz = plane_moments<V>(g, 11, 13),
                          yz = plane_moments<V>(g, 15, 17);
    const V second[3] = {g[1] + g[2] + xy.fourth + xz.fourth, g[3] + g[4] + xy.fourth + yz.fourth,
                         g[5] + g[6] + xz.fourth + yz.fourth};
    const V third = T(1. / 3) * cell.density_deviation;
    V normal[3],
        shear[3] = {xy.shear - rho * u[0] * u[1], xz.shear - rho * u[0] * u[2], yz.shear - rho * u[1] * u[2]};
    for (int a = 0; a < 3; ++a) normal[a] = second[a] - third - rho * u[a] * u[a];
    if constexpr (kForced) {
      const auto& f = cell.force;
      for (int a = 0; a < 3; ++a) normal[a] = normal[a] + u[a] * f[a];
      shear[0] = shear[0] + T(0.5) * (u[0] * f[1] + u[1] * f[0]);
      shear[1] = shear[1] + T(0.5) * (u[0] * f[2] + u[2] * f[0]);
      shear[2] = shear[2] + T(0.5) * (u[1] * f[2] + u[2] * f[1]);
    }
    V rate = broadcast<T>(call.even_rate);
    if constexpr (kEddy) {
      const V squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] +
                        T(2) * (shear[0] * shear[0] + shear[1] * shear[1] + shear[2] * shear[2]);
      rate = T(1) / eddy_relaxation_time<T>(call, squared, rho);
    }
    const V trace_third = T(1. / 3) * (normal[0] + normal[1] + normal[2]);
    V change[3], change_shear[3];
    for (int a = 0; a < 3; ++a) {
      change[a] = -rate * (normal[a] - trace_third) - trace_third;
      change_shear[a] = -rate * shear[a];
    }
    const auto in_xy =
        plane_change<T>(xy, cell, 0, 1, second[0], second[1], change[0], change[1], change_shear[0]);
    const auto in_xz =
        plane_change<T>(xz, cell, 0, 2, second[0], second[2], change[0], change[2], change_shear[1]);
    const auto in_yz =
        plane_change<T>(yz, cell, 1, 2, second[1], second[2], change[1], change[2], change_shear[2]);
    add_to_plane<T>(g, 7, 9, in_xy);
    add_to_plane<T>(g, 11, 13, in_xz);
    add_to_plane<T>(g, 15, 17, in_yz);
    V first[3] = {};
    if constexpr (kForced)
      for (int a = 0; a < 3; ++a) {
        first[a] = cell.force[a];
        change[a] = change[a] + T(2) * u[a] * cell.force[a];
      }
    add_along_axes<T>(g, change, first, in_xy, in_xz, in_yz);
  }

  /// The populations along the axes and at rest take what the planes leave of the moments up to second order.
  template <class T>
  [[gnu::always_inline]] static void add_along_axes(Pack<T> (&g)[kDirections], const Pack<T> (&second)[3],
                                                    const Pack<T> (&first)[3],
                                                    const PlaneMoments<Pack<T>>& xy,
                                                    const PlaneMoments<Pack<T>>& xz,
                                                    const PlaneMoments<Pack<T>>& yz) {
    using V = Pack<T>;
    const V even[3] = {T(0.5) * (second[0] - xy.fourth - xz.fourth),
                       T(0.5) * (second[1] - xy.fourth - yz.fourth),
                       T(0.5) * (second[2] - xz.fourth - yz.fourth)};
    const V odd[3] = {T(0.5) * (first[0] - xy.third_a - xz.third_a),
                      T(0.5) * (first[1] - xy.third_b - yz.third_a),
                      T(0.5) * (first[2] - xz.third_b - yz.third_b)};
    for (int a = 0; a < 3; ++a) {
      g[2 * a + 1] = g[2 * a + 1] + even[a] + odd[a];
      g[2 * a + 2] = g[2 * a + 2] + even[a] - odd[a];
    }
    g[0] = g[0] - second[0] - second[1] - second[2] + xy.fourth + xz.fourth + yz.fourth;
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
