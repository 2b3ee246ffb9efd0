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

/// BGK and TRT: even and odd parts of each pair of directions relax at their own rates (thesis eq 3.22 for
/// equal ones; docs key: ginzburg2008), with Guo's force term split the same way (docs key: guo2002).
template <bool kForced, bool kEddy, bool kComoving = false>
struct TwoRates {
  /// Q = sum c c (f - feq), the force's own share taken out; tangential: xy, xz, yz.
  template <class T>
  struct Stress {
    Pack<T> normal[3], tangential[3];
  };
  template <class T, class Populations>
  [[gnu::always_inline]] static Stress<T> stress_of(const Populations& g, const CellPack<T>& cell) {
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
  [[gnu::always_inline]] static Pack<T> squared(const Stress<T>& stress) {
    const auto &normal = stress.normal, &tangential = stress.tangential;
    return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] +
           T(2) * (tangential[0] * tangential[0] + tangential[1] * tangential[1] +
                   tangential[2] * tangential[2]);
  }

  /// What CollisionOperator::trt_comoving adds to a collision with the even rate for all parts. With Q the
  /// third moments about the velocity of what is out of equilibrium,
  ///   Q_xyy = sum (f - feq) (c_x - u_x) (c_y - u_y)^2,
  /// whose rate is the odd one: half of the difference that makes to them, and a quarter of what it makes to
  /// the fourth moments of the lattice's frame, sum f c_x^2 c_y^2. These have the equilibrium
  /// rho (1/9 + (u_x^2 + u_y^2)/3) here, without the -u_z^2/6 of thesis eq 3.25.
  template <class T>
  struct Comoving {
    Pack<T> third[3][3];  ///< [a][b]: of c_a c_b^2
    Pack<T> fourth[3];    ///< xy, xz, yz

    template <int Direction>
    [[gnu::always_inline]] Pack<T> even() const {
      constexpr const int* c = kVelocity[Direction];
      if constexpr (Direction > 6) return fourth[(c[0] != 0 ? 0 : 1) + (c[2] != 0 ? 1 : 0)];
      if constexpr (c[0] != 0) return T(-2) * (fourth[0] + fourth[1]);
      if constexpr (c[1] != 0) return T(-2) * (fourth[0] + fourth[2]);
      return T(-2) * (fourth[1] + fourth[2]);
    }
    template <int Direction>
    [[gnu::always_inline]] Pack<T> odd() const {
      constexpr const int* c = kVelocity[Direction];
      constexpr int first = c[0] != 0 ? 0 : c[1] != 0 ? 1 : 2;  // always along +
      if constexpr (Direction <= 6) {
        return -(third[first][(first + 1) % 3] + third[first][(first + 2) % 3]);
      } else {
        constexpr int second = c[2] != 0 ? 2 : 1;
        return T(0.5) * (third[first][second] + T(c[second]) * third[second][first]);
      }
    }
    [[gnu::always_inline]] Pack<T> rest() const { return T(4) * (fourth[0] + fourth[1] + fourth[2]); }
  };

  /// Of what pairs' differences are; `stress` as above.
  template <class T, class Populations>
  [[gnu::always_inline]] static Comoving<T> comoving_parts(const Populations& g, const CellPack<T>& cell,
                                                           const Stress<T>& stress, const Pack<T>& even_rate,
                                                           const Pack<T>& odd_rate) {
    const auto difference = [&](int i) { return g.get(i) - g.get(i + 1); };
    const auto& u = cell.velocity;
    Comoving<T> parts;
    Pack<T> flow[3] = {difference(1), difference(3), difference(5)};  // becomes the momentum without force
    for (int plane = 0; plane < 3; ++plane) {
      const int a = plane == 2 ? 1 : 0, b = plane == 0 ? 1 : 2;
      const Pack<T> straight = difference(7 + 4 * plane), across = difference(9 + 4 * plane);
      parts.third[a][b] = straight + across;
      parts.third[b][a] = straight - across;
      flow[a] = flow[a] + parts.third[a][b];
      flow[b] = flow[b] + parts.third[b][a];
    }
    const Pack<T> half = T(0.5) * (even_rate - odd_rate), fourth = (T(1. / 24) * even_rate) * cell.density;
    for (int plane = 0; plane < 3; ++plane) {
      const int a = plane == 2 ? 1 : 0, b = plane == 0 ? 1 : 2, c = 3 - a - b;
      const auto about_velocity = [&](int one, int squared) {
        return half * (parts.third[one][squared] - T(1. / 3) * flow[one] -
                       T(2) * u[squared] * stress.tangential[plane] - u[one] * stress.normal[squared]);
      };
      parts.third[a][b] = about_velocity(a, b);
      parts.third[b][a] = about_velocity(b, a);
      parts.fourth[plane] = u[a] * parts.third[a][b] + u[b] * parts.third[b][a] + fourth * u[c] * u[c];
      if constexpr (kForced)
        parts.fourth[plane] =
            parts.fourth[plane] + (T(1. / 12) - T(1. / 24) * even_rate) * u[c] * cell.force[c];
    }
    return parts;
  }

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
                                                const Shared<T>& shared, const Comoving<T>& parts) {
    const Pack<T> forward = g.get(Direction), backward = g.get(Direction + 1);
    const Pack<T> sum = forward + backward, difference = forward - backward;
    const Pack<T> cu = along<Direction>(cell.velocity), slope = along<Direction>(shared.slope);
    Pack<T> even = keep_even * sum + (slope * cu + shared.isotropic);
    Pack<T> odd = keep_odd * difference + along<Direction>(shared.odd);
    if constexpr (kComoving) {
      even = even + parts.template even<Direction>();
      odd = odd + parts.template odd<Direction>();
    }
    g.put(Direction, even + odd);
    g.put(Direction + 1, even - odd);
  }

  template <class T, class Populations>
  [[gnu::always_inline]] static void collide(Populations& g, const CellPack<T>& cell,
                                             const KernelCall<T>& call) {
    const auto& u = cell.velocity;
    Pack<T> even_rate = broadcast<T>(call.even_rate), odd_rate = broadcast<T>(call.odd_rate);
    Stress<T> stress;
    if constexpr (kEddy || kComoving) stress = stress_of<T>(g, cell);
    if constexpr (kEddy) {
      const Pack<T> tau = eddy_relaxation_time<T>(call, squared<T>(stress), cell.inverse_density);
      if (call.single_rate) {
        even_rate = odd_rate = T(1) / tau;
      } else {  // 1/tau and half/(half/2 + Lambda) with one division
        const Pack<T> half = tau - T(0.5), divisor = T(0.5) * half + call.magic;
        const Pack<T> inverse = T(1) / (tau * divisor);
        even_rate = divisor * inverse;
        odd_rate = (half * tau) * inverse;
      }
    }
    Comoving<T> parts;
    if constexpr (kComoving) {
      parts = comoving_parts<T>(g, cell, stress, even_rate, odd_rate);
      odd_rate = even_rate;
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
    Pack<T> rest = (T(1) - even_rate) * g.get(0) + w0 * isotropic;
    if constexpr (kComoving) rest = rest + parts.rest();
    g.put(0, rest);
    relax_pair<1, T>(g, cell, keep_even, keep_odd, axes, parts);
    relax_pair<3, T>(g, cell, keep_even, keep_odd, axes, parts);
    relax_pair<5, T>(g, cell, keep_even, keep_odd, axes, parts);
    relax_pair<7, T>(g, cell, keep_even, keep_odd, diagonals, parts);
    relax_pair<9, T>(g, cell, keep_even, keep_odd, diagonals, parts);
    relax_pair<11, T>(g, cell, keep_even, keep_odd, diagonals, parts);
    relax_pair<13, T>(g, cell, keep_even, keep_odd, diagonals, parts);
    relax_pair<15, T>(g, cell, keep_even, keep_odd, diagonals, parts);
    relax_pair<17, T>(g, cell, keep_even, keep_odd, diagonals, parts);
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
