#include "suffuse/micromechanics/constriction_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace suffuse::micromechanics {

namespace {

using std::numbers::pi;

/// Angle between the sides a and b of a triangle, opposite to c.
double angle_between(double a, double b, double c) {
  return std::acos(std::clamp((a * a + b * b - c * c) / (2 * a * b), -1.0, 1.0));
}

double third_side(double a, double b, double angle) {
  return std::sqrt(std::max(0.0, a * a + b * b - 2 * a * b * std::cos(angle)));
}

/// The largest value of a function with one maximum in [low, high].
template <class Function>
double golden_section(const Function& function, double low, double high) {
  const double share = (std::sqrt(5.0) - 1) / 2;
  double left = high - share * (high - low), right = low + share * (high - low);
  double at_left = function(left), at_right = function(right);
  while (high - low > 1e-9) {
    if (at_left > at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = function(left = high - share * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = function(right = low + share * (high - low));
    }
  }
  return std::max(at_left, at_right);
}

/// Disc that touches all four grains of a ring: the angles under which it sees neighbours add up to 2π. Where
/// opposite grains would overlap then, they touch, and the larger of the two holes beside them is left.
double inscribed_in_ring(const std::array<double, 4>& diameters) {
  std::array<double, 4> radius{};
  std::transform(diameters.begin(), diameters.end(), radius.begin(), [](double d) { return d / 2; });
  const auto seen = [&](std::size_t i, std::size_t j, double r) {
    return angle_between(radius[i] + r, radius[j] + r, radius[i] + radius[j]);
  };
  // The angles fall with r, from 4π at none; at the largest grain's own size they are at most 4 × π/3.
  double low = 0, high = *std::max_element(radius.begin(), radius.end());
  for (int step = 0; step < 60; ++step) {
    const double r = (low + high) / 2;
    (seen(0, 1, r) + seen(1, 2, r) + seen(2, 3, r) + seen(3, 0, r) > 2 * pi ? low : high) = r;
  }
  const double r = (low + high) / 2;
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const std::size_t next = i + 1, opposite = i + 2, last = (i + 3) % 4;
    const double angle = seen(i, next, r) + seen(next, opposite, r);
    const double apart = third_side(radius[i] + r, radius[opposite] + r, std::min(angle, 2 * pi - angle));
    if (apart < radius[i] + radius[opposite])
      return std::max(three_grain_constriction(diameters[i], diameters[next], diameters[opposite]),
                      three_grain_constriction(diameters[i], diameters[last], diameters[opposite]));
  }
  return 2 * r;
}

/// Of a ring, the diagonals at which opposite grains touch or a corner is straight bound the angle at the
/// first.
double largest_free_area(const std::array<double, 4>& d) {
  const double a = (d[0] + d[1]) / 2, b = (d[1] + d[2]) / 2, c = (d[2] + d[3]) / 2, e = (d[3] + d[0]) / 2;
  // Diagonal across the first grain (from the second to the fourth): shortest when these two touch, longest
  // when the first and the third do.
  const double shortest = std::max({(d[1] + d[3]) / 2, std::abs(a - e), std::abs(b - c)});
  const double across = (d[0] + d[2]) / 2;
  const double at_first = angle_between(a, across, b) + angle_between(e, across, c);
  const double longest = at_first < pi ? third_side(a, e, at_first) : std::min(a + e, b + c);
  const double low = angle_between(a, e, shortest), high = angle_between(a, e, std::max(longest, shortest));
  // Round-off at the ends would make the ring there seem impossible.
  const double inset = 1e-9 * (high - low);
  return golden_section([&](double angle) { return four_grain_area(d, angle); }, low + inset, high - inset);
}

double factorial(std::size_t n) {
  return n < 2 ? 1 : static_cast<double>(n) * factorial(n - 1);
}

/// Probability to draw these classes (indices in rising order) in any order: k!/(Π r!) Π p^r.
template <std::size_t k>
double probability(const std::array<std::size_t, k>& drawn, std::span<const double> fractions) {
  double result = factorial(k);
  std::size_t repeats = 0;
  for (std::size_t i = 0; i < k; ++i) {
    repeats = i > 0 && drawn[i] == drawn[i - 1] ? repeats + 1 : 1;
    result *= fractions[drawn[i]] / static_cast<double>(repeats);
  }
  return result;
}

}  // namespace

std::vector<double> class_fractions(std::span<const GradingClass> classes, FractionBy by) {
  std::vector<double> fractions;
  for (const GradingClass& one : classes) {
    double weight = one.mass;
    if (by == FractionBy::surface_area) weight /= one.diameter;
    if (by == FractionBy::number) weight /= one.diameter * one.diameter * one.diameter;
    fractions.push_back(weight);
  }
  const double total = std::accumulate(fractions.begin(), fractions.end(), 0.0);
  for (double& fraction : fractions) fraction /= total;
  return fractions;
}

double three_grain_constriction(double d1, double d2, double d3) {
  const double k1 = 2 / d1, k2 = 2 / d2, k3 = 2 / d3;
  return 2 / (k1 + k2 + k3 + 2 * std::sqrt(k1 * k2 + k2 * k3 + k3 * k1));
}

double four_grain_area(const std::array<double, 4>& d, double angle) {
  const double side12 = (d[0] + d[1]) / 2, side23 = (d[1] + d[2]) / 2, side34 = (d[2] + d[3]) / 2,
               side41 = (d[3] + d[0]) / 2;
  const double diagonal = third_side(side12, side41, angle);
  constexpr double rounding = 1e-12;
  if (diagonal > (side23 + side34) * (1 + rounding) ||
      diagonal < std::abs(side23 - side34) * (1 - rounding) || diagonal < (d[1] + d[3]) / 2 * (1 - rounding))
    return -1;
  const double at3 = angle_between(side23, side34, diagonal);
  const double at2 = angle_between(side12, diagonal, side41) + angle_between(side23, diagonal, side34);
  const double at4 = angle_between(side41, diagonal, side12) + angle_between(side34, diagonal, side23);
  const double across = third_side(side12, side23, std::min(at2, 2 * pi - at2));
  if (across < (d[0] + d[2]) / 2 * (1 - rounding)) return -1;
  return 0.125 *
         ((d[0] + d[1]) * (d[0] + d[3]) * std::sin(angle) + (d[1] + d[2]) * (d[2] + d[3]) * std::sin(at3) -
          (angle * d[0] * d[0] + at2 * d[1] * d[1] + at3 * d[2] * d[2] + at4 * d[3] * d[3]));
}

double four_grain_constriction(const std::array<double, 4>& diameters, LoosePore pore) {
  if (pore == LoosePore::inscribed) return inscribed_in_ring(diameters);
  return std::sqrt(4 * std::max(0.0, largest_free_area(diameters)) / pi);
}

double SizeDistribution::quantile(double share) const {
  const auto above = std::lower_bound(finer.begin(), finer.end(), share);
  if (above == finer.begin()) return diameters.front();
  if (above == finer.end()) return diameters.back();
  const auto i = static_cast<std::size_t>(above - finer.begin());
  return std::lerp(diameters[i - 1], diameters[i], (share - finer[i - 1]) / (finer[i] - finer[i - 1]));
}

double SizeDistribution::finer_at(double diameter) const {
  if (diameter < diameters.front()) return 0;
  if (diameter >= diameters.back()) return 1;
  const auto above = std::upper_bound(diameters.begin(), diameters.end(), diameter);
  const auto i = static_cast<std::size_t>(above - diameters.begin());
  return std::lerp(finer[i - 1], finer[i], (diameter - diameters[i - 1]) / (diameters[i] - diameters[i - 1]));
}

SizeDistribution size_distribution(std::vector<std::pair<double, double>> weighted_sizes) {
  std::sort(weighted_sizes.begin(), weighted_sizes.end());
  double total = 0;
  for (const auto& [size, weight] : weighted_sizes) total += weight;
  SizeDistribution result;
  double below = 0;
  for (std::size_t i = 0; i < weighted_sizes.size();) {
    const double size = weighted_sizes[i].first;
    double own = 0;
    for (; i < weighted_sizes.size() && weighted_sizes[i].first <= size * (1 + 1e-9); ++i)
      own += weighted_sizes[i].second;
    if (own > 0) {
      result.diameters.push_back(size);
      result.finer.push_back(std::min(1.0, (below + own / 2) / total));
      below += own;
    }
  }
  return result;
}

SizeDistribution dense_constrictions(std::span<const GradingClass> classes,
                                     std::span<const double> fractions) {
  std::vector<std::pair<double, double>> sizes;
  for (std::size_t i = 0; i < classes.size(); ++i)
    for (std::size_t j = i; j < classes.size(); ++j)
      for (std::size_t k = j; k < classes.size(); ++k)
        sizes.emplace_back(
            three_grain_constriction(classes[i].diameter, classes[j].diameter, classes[k].diameter),
            probability<3>({i, j, k}, fractions));
  return size_distribution(std::move(sizes));
}

SizeDistribution loose_constrictions(std::span<const GradingClass> classes, std::span<const double> fractions,
                                     LoosePore pore) {
  std::vector<std::pair<double, double>> sizes;
  for (std::size_t i = 0; i < classes.size(); ++i)
    for (std::size_t j = i; j < classes.size(); ++j)
      for (std::size_t k = j; k < classes.size(); ++k)
        for (std::size_t l = k; l < classes.size(); ++l) {
          const double a = classes[i].diameter, b = classes[j].diameter, c = classes[k].diameter,
                       d = classes[l].diameter;
          const double third = probability<4>({i, j, k, l}, fractions) / 3;
          for (const std::array<double, 4>& ring :
               {std::array{a, b, c, d}, std::array{a, c, b, d}, std::array{a, b, d, c}})
            sizes.emplace_back(four_grain_constriction(ring, pore), third);
        }
  return size_distribution(std::move(sizes));
}

double ConstrictionSizes::at(double share, double relative_density) const {
  const double tight = dense.quantile(share);
  return tight + share * (1 - relative_density) * (loose.quantile(share) - tight);
}

ConstrictionSizes constriction_sizes(std::span<const GradingClass> classes, FractionBy by, LoosePore pore) {
  const std::vector<double> fractions = class_fractions(classes, by);
  return {dense_constrictions(classes, fractions), loose_constrictions(classes, fractions, pore)};
}

double kovacs_pore_diameter(std::span<const GradingClass> classes, double porosity, double shape) {
  return 4 * porosity / (1 - porosity) * effective_diameter(classes) / shape;
}

double skeleton_porosity(double porosity, double fines) {
  return porosity + fines * (1 - porosity);
}

}  // namespace suffuse::micromechanics
