#pragma once

#include <cstddef>
#include <cstdint>

#include "suffuse/lbm/lattice.h"
#include "suffuse/lbm/solid_operators.h"

namespace suffuse::lbm {

/// SolidWeighting as one formula, with S the strength and eps the fraction of a cell:
///   B = S numerator / (open max(0, 1 - eps) + strength S + constant max(1, eps)).
template <class T>
struct WeightingTerms {
  T numerator, open, strength, constant;
};

/// What one sweep of a collide-and-stream kernel reads and writes: plain data, in lattice units.
///
/// place[i] points at what inner cell (0,0,0) reads for direction i; cell (x,y,z) reads its own at
/// x + row_pitch*y + plane_pitch*z from there and writes direction i to the place of the opposite direction.
template <class T>
struct KernelCall {
  T* place[kDirections];
  std::ptrdiff_t row_pitch;
  std::ptrdiff_t plane_pitch;
  int cells_x;
  int begin_y, end_y;
  int begin_z, end_z;

  T relaxation_time;   ///< of the even (stress) moments
  T even_rate;         ///< 1/relaxation_time
  T odd_rate;          ///< rate of the odd moments; equals even_rate for BGK
  T magic;             ///< TRT's Lambda; with `single_rate` unused
  bool single_rate;    ///< BGK: under an eddy viscosity the odd rate follows the even one
  T eddy_coefficient;  ///< 18 sqrt(2) C^2 of Smagorinsky's model
  T compressibility;   ///< 1; 0 with the incompressible equilibrium
  T force[3];          ///< per cell and step

  /// 0: fluid; anything else: solid. Indexed like the places, ghost cells included; may be null without
  /// solids.
  const std::uint8_t* solid;

  /// Partly covered cells: see partial_solids.h for the arrays. Null without them.
  const float* fraction;
  const float* strength;
  const float* solid_momentum[3];
  T* exchange[3];
  /// How many cells ahead the arrays above are fetched: those that the sweep comes to next, or, where
  /// somebody writes them just before, those that are written next. The exchange only in the first case.
  std::ptrdiff_t solids_ahead;
  bool exchange_ahead;
  SolidOperator solid_operator;
  WeightingTerms<T> weighting;
};

/// What kind of solids a kernel is compiled for.
enum class SolidKind {
  none,
  mask,   ///< whole cells
  mixed,  ///< partly covered cells by one of the operators that take a share of the collision
#define SUFFUSE_WORD(word, ...) word,
#define SUFFUSE_NOTHING(...)
  SUFFUSE_SOLID_OPERATORS(SUFFUSE_NOTHING, SUFFUSE_WORD)  // partly covered cells by this drag
#undef SUFFUSE_WORD
  count
};

constexpr SolidKind kind_of(SolidOperator solid_operator) {
#define SUFFUSE_KIND(word, ...) \
  if (solid_operator == SolidOperator::word) return SolidKind::word;
  SUFFUSE_SOLID_OPERATORS(SUFFUSE_NOTHING, SUFFUSE_KIND)
#undef SUFFUSE_KIND
#undef SUFFUSE_NOTHING
  return SolidKind::mixed;
}

/// The other way round, for a drag.
constexpr SolidOperator drag_of(SolidKind kind) {
  for (const SolidFacts& facts : kSolidOperators)
    if (kind_of(facts.solid_operator) == kind) return facts.solid_operator;
  return SolidOperator{};
}

/// Which pieces a kernel of a law is compiled with; a scene runs a kernel that has no others.
struct KernelVariant {
  bool forced = false;
  bool eddy_viscosity = false;
  SolidKind solids = SolidKind::none;
};

constexpr int kKernelVariants = 4 * static_cast<int>(SolidKind::count);

constexpr int index_of(const KernelVariant& v) {
  return (v.forced ? 1 : 0) + (v.eddy_viscosity ? 2 : 0) + 4 * static_cast<int>(v.solids);
}

constexpr KernelVariant variant_of(int index) {
  return {(index & 1) != 0, (index & 2) != 0, static_cast<SolidKind>(index / 4)};
}

template <class T>
using Kernel = void (*)(const KernelCall<T>&);

/// Reads the 19 values of each cell, multiplies by `even_rate`, adds `force[0]` and writes them back: what
/// the memory of the machine allows, the measure of the benchmarks. With 1 and 0 the fluid stays as it is.
template <class T>
using BareUpdate = void (*)(const KernelCall<T>&);

}  // namespace suffuse::lbm
