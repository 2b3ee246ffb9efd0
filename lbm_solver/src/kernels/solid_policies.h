#pragma once

#include "collide_two_rates.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// A solid policy is how a collision reads solid cells. It has two hooks, both given the index of the pack's
/// first cell and how many of its lanes are cells of the row:
///   force(cells, lanes, call, density deviation, momentum, force)  before the velocity is formed, may add a
///   force; mix(cells, lanes, call, before, after)                         after the collision, may replace
///   populations.
/// Constants say what a policy uses, so that the others cost nothing. Streaming and boundaries know of
/// neither: partly covered cells are added by writing one more policy.
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
                                         const Pack<T> (&)[kDirections], Pack<T> (&after)[kDirections]) {
    bool any = false;
    for (int lane = 0; lane < lanes; ++lane) any |= call.solid[cells + lane] != 0;
    if (!any) return;
    Pack<T> fluid{};
    for (int lane = 0; lane < lanes; ++lane) fluid[lane] = call.solid[cells + lane] != 0 ? T(0) : T(1);
    for (int i = 0; i < kDirections; ++i) after[i] = fluid != T(0) ? after[i] : Pack<T>{};
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
