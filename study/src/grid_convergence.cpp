#include "suffuse/study/grid_convergence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace suffuse::study {
namespace {

using Kind = GridConvergence::Kind;

constexpr double kEqual = 1e-12;                  // share of a value
constexpr double kLargestOrder = 64;              // beyond any method; the powers stay finite
constexpr double kCertain = 1.25, kDoubtful = 3;  // F
constexpr double kNear = 0.1, kLeastOrder = 0.5;
constexpr double kRefinement = 1.3;
constexpr int kHalvings = 60;

/// Rises with p from ln r32 / ln r21 on.
double ratio_of_steps(double p, double r21, double r32) {
  return std::pow(r21, p) * std::expm1(p * std::log(r32)) / std::expm1(p * std::log(r21));
}

double order_of(double steps, double r21, double r32) {
  double low = 0, high = kLargestOrder;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (ratio_of_steps(middle, r21, r32) < steps ? low : high) = middle;
  }
  return high;
}

/// Richardson's value from the two finest, by the order q.
void set_value(GridConvergence& result, std::span<const GridResult> runs, double q, double factor) {
  const double beyond =
      (runs[0].value - runs[1].value) / std::expm1(q * std::log(runs[1].spacing / runs[0].spacing));
  result.value = runs[0].value + beyond;
  result.error_bar = factor * std::abs(beyond);
}

Kind kind_of(double fine, double coarse, double least_ratio, double scale) {
  const auto none = [&](double step) { return std::abs(step) <= kEqual * scale; };
  if (none(fine)) return none(coarse) ? Kind::unchanged : Kind::stalled;
  if (none(coarse)) return Kind::diverging;
  if (fine * coarse < 0) return Kind::oscillating;
  return coarse / fine > least_ratio ? Kind::monotone : Kind::diverging;
}

std::vector<std::size_t> finest_of(const std::vector<double>& spacings, double refinement) {
  std::vector<std::size_t> order(spacings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return spacings[a] < spacings[b]; });
  std::vector<std::size_t> taken;
  for (const std::size_t i : order) {
    if (taken.size() == 3) break;
    const bool next = taken.empty() || (spacings[i] > spacings[taken.back()] &&
                                        spacings[i] >= refinement * spacings[taken.back()] * (1 - kEqual));
    if (next) taken.push_back(i);
  }
  return taken;
}

}  // namespace

GridConvergence extrapolate(std::span<const GridResult> runs, double order) {
  GridConvergence result;
  if (runs.size() < 2) return result;
  if (runs.size() == 2) {
    result.kind = Kind::two;
    set_value(result, runs, order, kDoubtful);
    return result;
  }
  const double r21 = runs[1].spacing / runs[0].spacing, r32 = runs[2].spacing / runs[1].spacing;
  const double fine = runs[1].value - runs[0].value, coarse = runs[2].value - runs[1].value;
  const double scale = std::max({std::abs(runs[0].value), std::abs(runs[1].value), std::abs(runs[2].value)});
  result.kind = kind_of(fine, coarse, std::log(r32) / std::log(r21), scale);
  if (result.kind == Kind::unchanged) {
    result.value = runs[0].value;
    result.error_bar = 0;
  }
  if (result.kind != Kind::monotone) return result;
  const double observed = order_of(coarse / fine, r21, r32);
  result.observed_order = observed;
  if (std::abs(observed - order) <= kNear * order)
    set_value(result, runs, order, kCertain);
  else
    set_value(result, runs, std::min(std::max(observed, kLeastOrder), order), kDoubtful);
  return result;
}

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::too_few:
      return "one resolution only";
    case Kind::two:
      return "two resolutions, the order is assumed";
    case Kind::monotone:
      return "converges";
    case Kind::unchanged:
      return "does not change";
    case Kind::stalled:
      return "the two finest are equal, the third is not: no order to be seen";
    case Kind::oscillating:
      return "oscillates";
    case Kind::diverging:
      return "does not converge: the finer step changes as much as the coarser";
  }
  return "";
}

std::vector<std::size_t> runs_to_extrapolate(const std::vector<double>& spacings) {
  std::vector<std::size_t> apart = finest_of(spacings, kRefinement);
  return apart.size() == 3 ? apart : finest_of(spacings, 1);
}

}  // namespace suffuse::study
