#pragma once

#include "cell_pack.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// A quarter of the raw moments of a plane of axes (a, b) after a collision: M_abb, M_aab and M_aabb. The
/// lattice has no others of third and fourth order.
template <class T>
struct PlaneMoments {
  Pack<T> third_a, third_b, fourth;
};

/// The four populations of a plane: directions `first` = (+,+), `second` = (+,-) and their opposites.
/// `second_moment` is a quarter of M_ab.
template <class T, class Populations>
[[gnu::always_inline]] inline void put_plane(Populations& g, int first, int second, const PlaneMoments<T>& m,
                                             const Pack<T>& second_moment) {
  const Pack<T> plus = m.fourth + second_moment, minus = m.fourth - second_moment;
  const Pack<T> sum = m.third_a + m.third_b, difference = m.third_a - m.third_b;
  g.put(first, plus + sum);
  g.put(first + 1, plus - sum);
  g.put(second, minus + difference);
  g.put(second + 1, minus - difference);
}

/// The two populations along an axis take what the planes leave of momentum and second moment; `third` and
/// `fourth` are the sums of the two planes' quarters.
template <bool kForced, class T, class Populations>
[[gnu::always_inline]] inline void put_axis(Populations& g, int axis, const CellPack<T>& cell,
                                            const Pack<T>& second, const Pack<T>& third,
                                            const Pack<T>& fourth) {
  Pack<T> momentum = cell.momentum[axis];
  if constexpr (kForced) momentum = momentum + T(0.5) * cell.force[axis];  // the whole force by now
  const Pack<T> even = T(0.5) * second - T(2) * fourth, odd = T(0.5) * momentum - T(2) * third;
  g.put(2 * axis + 1, even + odd);
  g.put(2 * axis + 2, even - odd);
}

/// All that planes leave: the populations along the axes and the one at rest. `normal` holds M_aa.
template <bool kForced, class T, class Populations>
[[gnu::always_inline]] inline void put_axes_and_rest(Populations& g, const CellPack<T>& cell,
                                                     const Pack<T> (&normal)[3], const PlaneMoments<T>& xy,
                                                     const PlaneMoments<T>& xz, const PlaneMoments<T>& yz) {
  put_axis<kForced, T>(g, 0, cell, normal[0], xy.third_a + xz.third_a, xy.fourth + xz.fourth);
  put_axis<kForced, T>(g, 1, cell, normal[1], xy.third_b + yz.third_a, xy.fourth + yz.fourth);
  put_axis<kForced, T>(g, 2, cell, normal[2], xz.third_b + yz.third_b, xz.fourth + yz.fourth);
  g.put(0, (cell.density_deviation - ((normal[0] + normal[1]) + normal[2])) +
               T(4) * ((xy.fourth + xz.fourth) + yz.fourth));
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
