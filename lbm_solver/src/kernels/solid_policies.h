#pragma once

#include "solid_cells.h"
#include "solid_laws.h"  // written by lbm_solver/CMakeLists.txt: every header of solids/

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

/// Calls act(SolidLaw<...>{}) for an operator that takes a share of the collision. A choice at each pair, not
/// a kernel for each of them: these kernels wait for memory, and would be as many again
/// (docs/decisions/fluid-kernels.md).
template <class Act>
[[gnu::always_inline]] inline void with_mixed_law(SolidOperator solid_operator, const Act& act) {
#define SUFFUSE_MIXED(word, ...)          \
  case SolidOperator::word:               \
    act(SolidLaw<SolidOperator::word>{}); \
    break;
#define SUFFUSE_DRAG(word, ...)
  switch (solid_operator) {
    SUFFUSE_SOLID_OPERATORS(SUFFUSE_MIXED, SUFFUSE_DRAG)
    default:
      __builtin_unreachable();  // a drag has a kernel of its own
  }
#undef SUFFUSE_MIXED
#undef SUFFUSE_DRAG
}

/// Partly covered cells by a solid operator that takes the share B of the collision. A force on the cell acts
/// on the fluid with 1 - B and on the solid with B.
template <bool kForced>
struct PartialMixed {
  static constexpr bool kAddsForce = false;
  static constexpr bool kMixes = true;

  /// A pair's equilibria less their weights, divided by the weight.
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
    Halves<T> change{};
    with_mixed_law(
        call.solid_operator, [&](auto law) __attribute__((always_inline)) {
          change = law.template pair<T>({w, solid, fluid, half_sum, half_difference, call});
        });
    const auto& [even, odd] = change;
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
    with_mixed_law(
        call.solid_operator, [&](auto law) __attribute__((always_inline)) {
          change = law.template rest<T>({solid, fluid, before[0], call});
        });
    after[0] = before[0] + (T(1) - mixing.weight) * (after[0] - before[0]) + mixing.weight * change;
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
