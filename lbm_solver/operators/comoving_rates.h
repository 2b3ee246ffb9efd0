#pragma once

#include "two_rates.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// TRT about the local velocity (docs/decisions/solid-operator.md): what it adds to a collision with the even
/// rate for all parts. With Q the third moments about the velocity of what is out of equilibrium,
///   Q_xyy = sum (f - feq) (c_x - u_x) (c_y - u_y)^2,
/// whose rate is the odd one: half of the difference that makes to them, and a quarter of what it makes to
/// the fourth moments of the lattice's frame, sum f c_x^2 c_y^2. These have the equilibrium
/// rho (1/9 + (u_x^2 + u_y^2)/3) here, without the -u_z^2/6 of thesis eq 3.25.
template <bool kForced>
struct ComovingFrame {
  static constexpr bool kAdds = true;

  template <class T>
  struct Parts {
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
  [[gnu::always_inline]] static Parts<T> parts(const Populations& g, const CellPack<T>& cell,
                                               const Stress<T>& stress, const Pack<T>& even_rate,
                                               const Pack<T>& odd_rate) {
    const auto difference = [&](int i) { return g.get(i) - g.get(i + 1); };
    const auto& u = cell.velocity;
    Parts<T> added;
    Pack<T> flow[3] = {difference(1), difference(3), difference(5)};  // becomes the momentum without force
    for (int plane = 0; plane < 3; ++plane) {
      const int a = plane == 2 ? 1 : 0, b = plane == 0 ? 1 : 2;
      const Pack<T> straight = difference(7 + 4 * plane), across = difference(9 + 4 * plane);
      added.third[a][b] = straight + across;
      added.third[b][a] = straight - across;
      flow[a] = flow[a] + added.third[a][b];
      flow[b] = flow[b] + added.third[b][a];
    }
    const Pack<T> half = T(0.5) * (even_rate - odd_rate), fourth = (T(1. / 24) * even_rate) * cell.density;
    for (int plane = 0; plane < 3; ++plane) {
      const int a = plane == 2 ? 1 : 0, b = plane == 0 ? 1 : 2, c = 3 - a - b;
      const auto about_velocity = [&](int one, int squared) {
        return half * (added.third[one][squared] - T(1. / 3) * flow[one] -
                       T(2) * u[squared] * stress.tangential[plane] - u[one] * stress.normal[squared]);
      };
      added.third[a][b] = about_velocity(a, b);
      added.third[b][a] = about_velocity(b, a);
      added.fourth[plane] = u[a] * added.third[a][b] + u[b] * added.third[b][a] + fourth * u[c] * u[c];
      if constexpr (kForced)
        added.fourth[plane] =
            added.fourth[plane] + (T(1. / 12) - T(1. / 24) * even_rate) * u[c] * cell.force[c];
    }
    return added;
  }
};

namespace comoving_rates {
template <bool kForced, bool kEddy>
using Law = TwoRates<kForced, kEddy, ComovingFrame<kForced>>;
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
