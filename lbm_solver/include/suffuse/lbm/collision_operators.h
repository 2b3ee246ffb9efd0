#pragma once

namespace suffuse::lbm {

/// Every collision operator of the fluid, one line each; enumeration, script words, kernels, build targets,
/// tests and the table of docs/reference/lbm.md follow from it.
///
/// - word: in scripts, and of CollisionOperator.
/// - law: lbm_solver/operators/LAW.h, whose kernels it runs; the function LAW of reference_collision.cpp is
///   its oracle.
/// - rate of the odd moments, see OddRate.
/// - the lowest relaxation time at which water that grains stir gains no energy (hard case low_viscosity); 0
///   if it gains none at any.
// clang-format off
#define SUFFUSE_COLLISION_OPERATORS(OPERATOR) \
  OPERATOR(bgk, two_rates, one, 0, "one relaxation time (thesis eqs 3.20-3.22)") \
  OPERATOR(trt, two_rates, magic, 0, "two relaxation times: odd parts tied to the viscosity's by `magic`") \
  OPERATOR(trt_comoving, comoving_rates, magic, 0, "`trt` about the local velocity: for beds that carry their water along fast") \
  OPERATOR(central_moments, central_moments, own, 0.503, "moments about the local velocity: for relaxation times near 0.5") \
  OPERATOR(cumulants, cumulants, own, 0, "as `central_moments`, fourth cumulants set to zero")
// clang-format on

enum class CollisionOperator {
#define SUFFUSE_WORD(word, ...) word,
  SUFFUSE_COLLISION_OPERATORS(SUFFUSE_WORD)
#undef SUFFUSE_WORD
};

/// How the rate of the odd moments comes about.
enum class OddRate {
  one,    ///< the even ones'
  magic,  ///< tied to it by the user's `magic`
  own,    ///< the law has no second rate
};

/// A line of the list.
struct CollisionFacts {
  CollisionOperator collision_operator;
  const char* word;
  OddRate odd_rate;
  double least_stirred_relaxation_time;
  const char* meaning;
};

inline constexpr CollisionFacts kCollisionOperators[] = {
#define SUFFUSE_FACTS(word, law, rates, stirred, meaning) \
  {CollisionOperator::word, #word, OddRate::rates, stirred, meaning},
    SUFFUSE_COLLISION_OPERATORS(SUFFUSE_FACTS)
#undef SUFFUSE_FACTS
};

constexpr const CollisionFacts& facts_of(CollisionOperator collision_operator) {
  return kCollisionOperators[static_cast<int>(collision_operator)];
}

}  // namespace suffuse::lbm
