#pragma once

namespace suffuse::lbm {

/// How a cell that solids cover in part treats the fluid in it, one line for each operator; enumeration,
/// script words, kernels, tests and the table of docs/reference/lbm.md follow from it. Its law is the header
/// of lbm_solver/solids with its word for a name.
///
/// - MIXED: a share B of the collision is replaced by a solid operator,
///   f' = f + (1-B) Omega_fluid + B Omega_solid (thesis eq 3.33; docs key: nobletorczynski1998). DRAG: the
///   full collision with a force of the solid's.
/// - share: in one step the momentum of a cell comes nearer to its solid's by this times B of the difference.
/// - terms of the automatic coefficient, see CoefficientLaw; nothing if it has none.
// clang-format off
#define SUFFUSE_SOLID_OPERATORS(MIXED, DRAG) \
  MIXED(sc1, 1, {}, "bounce-back of the non-equilibrium part (Noble and Torczynski)") \
  MIXED(sc2, 1, {}, "relaxation towards the solid's equilibrium (Noble and Torczynski)") \
  MIXED(sc3, 2, (CoefficientTerms{0.64, 2.25, 7.6, 30.1}), "bounce-back in the solid's frame (Owen et al.)") \
  DRAG(force, 2, (CoefficientTerms{1.7, 2.3, 15.2, 36, 124, 1.5, 0.012}), "a drag inside the cell, in Guo's form")
// clang-format on

enum class SolidOperator {
#define SUFFUSE_WORD(word, ...) word,
  SUFFUSE_SOLID_OPERATORS(SUFFUSE_WORD, SUFFUSE_WORD)
#undef SUFFUSE_WORD
};

/// Terms of an operator's automatic coefficient: see CoefficientLaw.
struct CoefficientTerms {
  double constant = 0, single = 0, crowded = 0, narrow = 0, tight = 0;
  double reach = 0;  ///< of the window, over the mean radius of surfaces around; 0: of any sphere its radius
  double swept = 0;  ///< share by which k falls where a sphere moves at one viscosity a cell
  constexpr bool given() const { return constant > 0; }
};

/// A line of the list.
struct SolidFacts {
  SolidOperator solid_operator;
  const char* word;
  double share;
  CoefficientTerms coefficient;
  const char* meaning;
};

inline constexpr SolidFacts kSolidOperators[] = {
#define SUFFUSE_FACTS(word, share, coefficient, meaning) \
  {SolidOperator::word, #word, share, coefficient, meaning},
    SUFFUSE_SOLID_OPERATORS(SUFFUSE_FACTS, SUFFUSE_FACTS)
#undef SUFFUSE_FACTS
};

constexpr const SolidFacts& facts_of(SolidOperator solid_operator) {
  return kSolidOperators[static_cast<int>(solid_operator)];
}

/// B as a function of the solid fraction eps, with t = tau - 1/2.
enum class SolidWeighting {
  fraction,               ///< B = eps
  noble_torczynski,       ///< B = eps t / ((1 - eps) + t) (thesis eq 3.34)
  viscosity_independent,  ///< B = k eps t / ((1 - eps) + r + k eps t): drag/viscosity depends on eps alone
};

/// r of the viscosity-independent weighting: what a whole cell keeps open. With r = 0 the velocity in a whole
/// cell becomes the solid's at half step, and its momentum overshoots by as much as it was away: inside a
/// grain it would swing to and fro for ever, and with it the force on a grain that is accelerated.
inline constexpr double kLeastOpenShare = 0.05;

}  // namespace suffuse::lbm
