#pragma once

#include "solid_cells.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// A drag inside the cell: full collision with a Guo force F = F_ext - 2B (j + F_ext/2 - rho us).
template <>
struct SolidLaw<SolidOperator::force> {
  static constexpr bool kAddsForce = true;
  static constexpr bool kMixes = false;

  /// The cell exchanges 2 B (m - rho us), m the momentum with half of the other forces; a unit of its
  /// strength S, 2/D (m - rho us) with D = S/B. One division gives 1/D and 1/S, which turns strength times
  /// velocity into us.
  template <class T>
  [[gnu::always_inline]] static void force(std::ptrdiff_t cells, int lanes, const KernelCall<T>& call,
                                           CellPack<T>& cell) {
    fetch_ahead(call, cells);
    const Pack<T> fraction = load_floats<T>(call.fraction + cells);
    if (!any_positive(fraction)) return;
    const Pack<T> strength = load_floats<T>(call.strength + cells);
    constexpr T least = static_cast<T>(kLeastStrength);
    const Pack<T> some = strength > least ? strength : broadcast<T>(least);
    const Pack<T> flow =
        (T(2) * call.weighting.numerator) / (some * weighting_divisor<T>(call.weighting, fraction, strength));
    const Pack<T> toward = flow * some, solid_flow = flow * cell.density, half_strength = T(0.5) * strength;
    Pack<T> exchange[3];
    for (int a = 0; a < 3; ++a) {
      exchange[a] = toward * cell.momentum[a] - solid_flow * load_floats<T>(call.solid_momentum[a] + cells);
      const Pack<T> half = half_strength * exchange[a];
      cell.force[a] = cell.force[a] - (half + half);
      cell.momentum[a] = cell.momentum[a] - half;
    }
    store_exchange<T>(call, cells, lanes, exchange);
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
