#pragma once

#include <optional>
#include <span>
#include <vector>

namespace suffuse::study {

/// What a run gives at a spacing; any unit, the same for all.
struct GridResult {
  double spacing = 0;  ///< > 0
  double value = 0;
};

/// What results at finer and finer spacings tell of the one at no spacing.
struct GridConvergence {
  enum class Kind {
    too_few,      ///< one result: nothing can be said
    two,          ///< two: the order is taken for granted
    monotone,     ///< three that close in from one side
    unchanged,    ///< all equal
    stalled,      ///< the two finest are equal, the third is not: no order can be observed
    oscillating,  ///< the second step goes the other way than the first
    diverging     ///< the second step is as large as the first, for the refinement, or larger
  };

  Kind kind = Kind::too_few;
  std::optional<double> observed_order;    ///< of monotone ones
  std::optional<double> value, error_bar;  ///< of `two`, `monotone` and `unchanged` alone
};

/// Richardson's extrapolation with a grid convergence index (roache1994), as celik2008 observe the order: it
/// is the p > 0 of
///
///     (f3 - f2)/(f2 - f1) = r21^p (r32^p - 1)/(r21^p - 1),   r21 = h2/h1, r32 = h3/h2, h1 the finest,
///     value = f1 + (f1 - f2)/(r21^q - 1),   error_bar = F |f1 - f2|/(r21^q - 1).
///
/// q and F follow oberkampf2010 (section 8.7): within a tenth of the method's own `order`, q = order and
/// F = 1.25; otherwise F = 3 and q = p, but no less than 0.5 and no more than order. Two results have
/// q = order, F = 3 (roache1994). The bar is as wide as the index of the finest run, so that its value lies
/// within it. `runs` holds the finest first, spacings strictly larger one by one; the first three count.
/// Differences below 1e-12 of a value are taken as none.
GridConvergence extrapolate(std::span<const GridResult> runs, double order);

/// "oscillates", "1 resolution only": why there is no value; what was done where there is one.
const char* to_string(GridConvergence::Kind kind);

/// The finest run and two coarser ones, each by a factor of 1.3 at least where there are such (celik2008),
/// the next ones otherwise; fewer where there are fewer. Indices into `spacings`, which stand in any order,
/// the finest first. Of equal spacings the first counts.
std::vector<std::size_t> runs_to_extrapolate(const std::vector<double>& spacings);

}  // namespace suffuse::study
