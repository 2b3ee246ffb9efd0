#pragma once

#include "cell_pack.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

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

/// Even and odd halves of what a pair of opposite directions has.
template <class T>
struct Halves {
  Pack<T> even, odd;
};

/// What a solid operator that takes the share B of a collision knows of a pair of opposite directions, all
/// less the weights: the equilibria at the solid's and at the fluid's velocity over the pair's weight, and
/// the halves of the populations' sum and difference.
template <class T>
struct SolidPair {
  T weight;
  const Halves<T>&solid, &fluid;
  const Pack<T>&half_sum, &half_difference;
  const KernelCall<T>& call;
};

/// The same of the population at rest, equilibria with their weight.
template <class T>
struct SolidRest {
  const Pack<T>&solid, &fluid, &population;
  const KernelCall<T>& call;
};

/// The law of a solid operator, one header each in lbm_solver/solids: what it adds to a population in place
/// of the fluid's collision (`pair` and `rest`), or, for a drag, the hook `force` of a solid policy.
template <SolidOperator kOperator>
struct SolidLaw;

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
