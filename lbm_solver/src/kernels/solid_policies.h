#pragma once

#include "collide_two_rates.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// A solid policy is how a collision reads solid cells. It has two hooks, both given the index of the pack's
/// first cell and how many of its lanes are cells of the row:
///   force(cells, lanes, call, cell)               before the velocity is formed, may add a force (half of
///   which
///                                                 the momentum has already);
///   mix(cells, lanes, call, cell, before, after)         after the collision, may replace populations.
/// Constants say what a policy uses, so that the others cost nothing. Streaming and boundaries know of
/// neither.
struct NoSolid {
  static constexpr bool kAddsForce = false;
  static constexpr bool kMixes = false;
};

/// Whole cells are solid: they stay at rest. The bounce-back off them is made on links, outside of the
/// kernel.
struct SolidMask {
  static constexpr bool kAddsForce = false;
  static constexpr bool kMixes = true;

  template <class T>
  [[gnu::always_inline]] static void mix(std::ptrdiff_t cells, int lanes, const KernelCall<T>& call,
                                         const CellPack<T>&, const Pack<T> (&)[kDirections],
                                         Pack<T> (&after)[kDirections]) {
    bool any = false;
    for (int lane = 0; lane < lanes; ++lane) any |= call.solid[cells + lane] != 0;
    if (!any) return;
    Pack<T> fluid{};
    for (int lane = 0; lane < lanes; ++lane) fluid[lane] = call.solid[cells + lane] != 0 ? T(0) : T(1);
    for (int i = 0; i < kDirections; ++i) after[i] = fluid != T(0) ? after[i] : Pack<T>{};
  }
};

/// As the populations' streams (see kPrefetchBytes in stream_collide.h): each line of floats once.
template <class T>
[[gnu::always_inline]] inline void fetch_ahead(const KernelCall<T>& call, std::ptrdiff_t cells) {
  constexpr std::ptrdiff_t floats = 16;
  if (kPackWidth<T> == floats || (cells & (floats - 1)) < kPackWidth<T>) {
    const std::ptrdiff_t at = cells + call.solids_ahead;
    __builtin_prefetch(call.fraction + at, 1);
    if (call.strength != call.fraction) __builtin_prefetch(call.strength + at, 1);
    for (int a = 0; a < 3; ++a) __builtin_prefetch(call.solid_momentum[a] + at, 1);
  }
  if (!call.exchange_ahead) return;
  for (int a = 0; a < 3; ++a) __builtin_prefetch(call.exchange[a] + cells + call.solids_ahead, 1);
}

template <class T>
[[gnu::always_inline]] inline void store_exchange(const KernelCall<T>& call, std::ptrdiff_t cells, int lanes,
                                                  const Pack<T> (&exchange)[3]) {
  for (int a = 0; a < 3; ++a) {
    if (lanes == kPackWidth<T>)
      store<T>(call.exchange[a] + cells, exchange[a]);
    else
      store_lanes<T>(call.exchange[a] + cells, exchange[a], lanes);
  }
}

/// A strength below this counts as this where it divides. Strengths are multiples of 2^-22, or nothing.
inline constexpr float kLeastStrength = 1e-12f;

/// The divisor of SolidWeighting's B. Where the fractions of a cell add up to more than one,
/// they shrink in proportion.
template <class T>
[[gnu::always_inline]] inline Pack<T> weighting_divisor(const WeightingTerms<T>& terms,
                                                        const Pack<T>& fraction, const Pack<T>& strength) {
  const Pack<T> clear = T(1) - fraction;
  const Pack<T> open = clear > T(0) ? clear : Pack<T>{};
  const Pack<T> covered = clear < T(0) ? fraction : Pack<T>{} + T(1);  // more than one where solids overlap
  return terms.open * open + terms.strength * strength + terms.constant * covered;
}

/// Partly covered cells as a drag inside the cell (SolidOperator::force).
struct PartialForce {
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

/// Partly covered cells by a solid operator that takes the share B of the collision. A force on the cell acts
/// on the fluid with 1 - B and on the solid with B.
template <bool kForced>
struct PartialMixed {
  static constexpr bool kAddsForce = false;
  static constexpr bool kMixes = true;

  /// Even and odd halves of a pair's equilibria less their weights, divided by the weight.
  template <class T>
  struct Halves {
    Pack<T> even, odd;
  };
  template <int Direction, class T>
  [[gnu::always_inline]] static Halves<T> equilibrium(const CellPack<T>& cell, const Pack<T> (&velocity)[3]) {
    const Pack<T> cu = along<Direction>(velocity);
    const Pack<T> u2 = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
    return {cell.density_deviation + cell.density * (T(4.5) * cu * cu - T(1.5) * u2),
            T(3) * cell.density * cu};
  }

  template <class T>
  struct Mixing {
    Pack<T> weight, solid_velocity[3];
    Pack<T> given[3];  ///< momentum that the solid operator gives to the fluid, before the factor B
  };

  template <int Direction, class T>
  [[gnu::always_inline]] static void mix_pair(const KernelCall<T>& call, const CellPack<T>& cell,
                                              Mixing<T>& mixing, const Pack<T> (&before)[kDirections],
                                              Pack<T> (&after)[kDirections]) {
    constexpr T w = static_cast<T>(kWeight[Direction]);
    const Halves<T> solid = equilibrium<Direction, T>(cell, mixing.solid_velocity);
    const Halves<T> fluid = equilibrium<Direction, T>(cell, cell.velocity);
    const Pack<T> half_sum = T(0.5) * (before[Direction] + before[Direction + 1]);
    const Pack<T> half_difference = T(0.5) * (before[Direction] - before[Direction + 1]);
    Pack<T> even, odd;
    switch (call.solid_operator) {
      case SolidOperator::sc1:
        even = w * (solid.even - fluid.even);
        odd = w * (solid.odd + fluid.odd) - T(2) * half_difference;
        break;
      case SolidOperator::sc2:
        even = w * solid.even - half_sum + (T(1) - call.even_rate) * (half_sum - w * fluid.even);
        odd = w * solid.odd - half_difference + (T(1) - call.odd_rate) * (half_difference - w * fluid.odd);
        break;
      default:
        even = Pack<T>{};
        odd = T(2) * (w * solid.odd - half_difference);
        break;
    }
    const Pack<T> keep = T(1) - mixing.weight;
    after[Direction] =
        before[Direction] + keep * (after[Direction] - before[Direction]) + mixing.weight * (even + odd);
    after[Direction + 1] = before[Direction + 1] + keep * (after[Direction + 1] - before[Direction + 1]) +
                           mixing.weight * (even - odd);
    constexpr const int* c = kVelocity[Direction];
    for (int a = 0; a < 3; ++a) {
      if (c[a] == 1) mixing.given[a] = mixing.given[a] + T(2) * odd;
      if (c[a] == -1) mixing.given[a] = mixing.given[a] - T(2) * odd;
    }
  }

  template <class T>
  [[gnu::always_inline]] static void mix(std::ptrdiff_t cells, int lanes, const KernelCall<T>& call,
                                         const CellPack<T>& cell, const Pack<T> (&before)[kDirections],
                                         Pack<T> (&after)[kDirections]) {
    const Pack<T> fraction = load_floats<T>(call.fraction + cells);
    if (!any_positive(fraction)) return;
    Mixing<T> mixing;
    const Pack<T> strength = load_floats<T>(call.strength + cells);
    const Pack<T> factor =
        call.weighting.numerator / weighting_divisor<T>(call.weighting, fraction, strength);
    mixing.weight = strength * factor;
    for (int a = 0; a < 3; ++a)
      mixing.solid_velocity[a] = factor * load_floats<T>(call.solid_momentum[a] + cells);
    const Pack<T> inverse = T(1) / (mixing.weight > T(0) ? mixing.weight : broadcast<T>(1));
    for (int a = 0; a < 3; ++a) {
      mixing.solid_velocity[a] = mixing.solid_velocity[a] * inverse;
      mixing.given[a] = Pack<T>{};
    }
    mix_rest(call, cell, mixing, before, after);
    mix_pair<1, T>(call, cell, mixing, before, after);
    mix_pair<3, T>(call, cell, mixing, before, after);
    mix_pair<5, T>(call, cell, mixing, before, after);
    mix_pair<7, T>(call, cell, mixing, before, after);
    mix_pair<9, T>(call, cell, mixing, before, after);
    mix_pair<11, T>(call, cell, mixing, before, after);
    mix_pair<13, T>(call, cell, mixing, before, after);
    mix_pair<15, T>(call, cell, mixing, before, after);
    mix_pair<17, T>(call, cell, mixing, before, after);
    Pack<T> exchange[3];
    for (int a = 0; a < 3; ++a) {
      exchange[a] = -mixing.given[a];
      if constexpr (kForced) exchange[a] = exchange[a] + cell.force[a];
      exchange[a] = factor * exchange[a];  // the weight is the strength times this
    }
    store_exchange<T>(call, cells, lanes, exchange);
  }

  template <class T>
  [[gnu::always_inline]] static void mix_rest(const KernelCall<T>& call, const CellPack<T>& cell,
                                              const Mixing<T>& mixing, const Pack<T> (&before)[kDirections],
                                              Pack<T> (&after)[kDirections]) {
    constexpr T w = static_cast<T>(kWeight[0]);
    const auto rest = [&](const Pack<T>(&u)[3]) -> Pack<T> {
      return w * (cell.density_deviation - T(1.5) * cell.density * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]));
    };
    const Pack<T> solid = rest(mixing.solid_velocity), fluid = rest(cell.velocity);
    Pack<T> change{};
    if (call.solid_operator == SolidOperator::sc1) change = solid - fluid;
    if (call.solid_operator == SolidOperator::sc2)
      change = solid - before[0] + (T(1) - call.even_rate) * (before[0] - fluid);
    after[0] = before[0] + (T(1) - mixing.weight) * (after[0] - before[0]) + mixing.weight * change;
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
