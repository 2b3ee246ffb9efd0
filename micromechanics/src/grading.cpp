#include "suffuse/micromechanics/grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "suffuse/common/error.h"

namespace suffuse::micromechanics {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-9;  // sums of shares such as 20 × 0.05 are exact to far less
constexpr std::size_t kMostSizes =
    200;  // more sizes of grains than this are gathered in so many equal shares

bool is_positive(double value) {
  return std::isfinite(value) && value > 0;
}

void check_diameters(std::span<const double> diameters) {
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    if (!is_positive(diameters[i]))
      throw_user_error({"grading", fmt::format("diameter {}", i + 1), fmt::format("{:g} m", diameters[i]),
                        "be positive and finite", ""});
    if (i > 0 && diameters[i] <= diameters[i - 1])
      throw_user_error({"grading", fmt::format("diameter {}", i + 1), fmt::format("{:g} m", diameters[i]),
                        fmt::format("be larger than the one before it, {:g} m", diameters[i - 1]),
                        "sort the sizes and write each once"});
  }
}

/// Logarithmic distances between neighbouring classes.
std::vector<double> spacings(const std::vector<GradingClass>& classes) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < classes.size(); ++i)
    result.push_back(std::log(classes[i + 1].diameter / classes[i].diameter));
  return result;
}

std::vector<bool> gaps_between(const std::vector<double>& spacing, const GapRule& rule) {
  std::vector<bool> gaps(spacing.size());
  for (std::size_t i = 0; i < spacing.size(); ++i) {
    double beside = 0;
    if (i > 0) beside = spacing[i - 1];
    if (i + 1 < spacing.size()) beside = std::max(beside, spacing[i + 1]);
    gaps[i] = spacing[i] >= std::log(rule.class_ratio) && spacing[i] >= rule.class_spacing * beside;
  }
  return gaps;
}

/// The classes spread over log d (see Grading).
std::vector<GradingPoint> spread(const std::vector<GradingClass>& classes, const GapRule& rule) {
  const std::vector<double> spacing = spacings(classes);
  const std::vector<bool> gap = gaps_between(spacing, rule);
  std::vector<GradingPoint> curve;
  double finer = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    double below = i > 0 && !gap[i - 1] ? spacing[i - 1] / 2 : -1;
    double above = i + 1 < classes.size() && !gap[i] ? spacing[i] / 2 : -1;
    if (below < 0) below = std::max(above, 0.0);
    if (above < 0) above = below;
    const double lower = classes[i].diameter * std::exp(-below);
    if (curve.empty() || lower > curve.back().diameter * (1 + kRounding)) curve.push_back({lower, finer});
    finer += classes[i].mass;
    curve.push_back({classes[i].diameter * std::exp(above), finer});
  }
  curve.back().finer = 1;
  return curve;
}

/// Where a flat stretch [first, end] of a curve begins: the upper classes of fines that are few may lie
/// within the rise that a stretch is allowed, but rise much more steeply than what follows.
std::size_t flat_from(const std::vector<GradingPoint>& curve, std::size_t first, std::size_t end,
                      const GapRule& rule) {
  constexpr double steeper = 3;
  const auto slope = [&](std::size_t a, std::size_t b) {
    return (curve[b].finer - curve[a].finer) / std::log(curve[b].diameter / curve[a].diameter);
  };
  while (first + 1 < end && slope(first, first + 1) > steeper * slope(first + 1, end) + kRounding &&
         curve[end].diameter >= rule.class_ratio * curve[first + 1].diameter)
    ++first;
  return first;
}

/// A flat stretch at an end of the curve that is not known is no gap: nobody knows how wide it is.
std::optional<GradingGap> widest_gap(const std::vector<GradingPoint>& curve, const GapRule& rule) {
  std::optional<GradingGap> widest;
  const double unknown_below = curve.front().finer;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    if (unknown_below > 0 && curve[i].finer - unknown_below <= rule.curve_rise) continue;
    std::size_t end = i + 1;
    if (curve[end].finer - curve[i].finer > rule.curve_rise) continue;
    while (end + 1 < curve.size() && curve[end + 1].finer - curve[i].finer <= rule.curve_rise) ++end;
    const std::size_t first = flat_from(curve, i, end, rule);
    const GradingGap found{curve[first].diameter, curve[end].diameter, curve[first].finer, 0};
    const bool inside = found.finer > 0.01 && curve[end].finer < 0.99;
    if (inside && found.ratio() >= rule.class_ratio && (!widest || found.ratio() > widest->ratio()))
      widest = found;
  }
  return widest;
}

double between(double x, double x0, double x1, double y0, double y1) {
  return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : y1;
}

double log_between(double finer, const GradingPoint& low, const GradingPoint& high) {
  return std::exp(between(finer, low.finer, high.finer, std::log(low.diameter), std::log(high.diameter)));
}

}  // namespace

Grading Grading::from_classes(std::span<const GradingClass> classes, const GapRule& rule) {
  if (classes.empty()) throw_user_error({"grading", "classes", "0", "be at least one", ""});
  std::vector<double> diameters;
  double total = 0;
  for (const GradingClass& one : classes) {
    if (!is_positive(one.mass))
      throw_user_error({"grading", fmt::format("mass of the class at {:g} m", one.diameter),
                        fmt::format("{:g}", one.mass), "be positive and finite", "leave empty classes out"});
    diameters.push_back(one.diameter);
    total += one.mass;
  }
  check_diameters(diameters);
  Grading grading;
  grading.classes_.assign(classes.begin(), classes.end());
  for (GradingClass& one : grading.classes_) one.mass /= total;
  grading.curve_ = spread(grading.classes_, rule);
  grading.gap_ = widest_gap(grading.curve_, rule);
  for (std::size_t i = 0; grading.gap_ && i + 1 < classes.size(); ++i)
    if (classes[i].diameter <= grading.gap_->finer_diameter &&
        classes[i + 1].diameter > grading.gap_->finer_diameter)
      grading.gap_->class_ratio = classes[i + 1].diameter / classes[i].diameter;
  return grading;
}

Grading Grading::from_curve(std::span<const GradingPoint> points, const GapRule& rule) {
  if (points.empty()) throw_user_error({"grading", "points", "0", "be at least two", ""});
  std::vector<double> diameters;
  for (const GradingPoint& point : points) diameters.push_back(point.diameter);
  check_diameters(diameters);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double finer = points[i].finer;
    const auto what = fmt::format("share finer than {:g} m", points[i].diameter);
    if (!std::isfinite(finer) || finer < 0 || finer > 1 + 5e-3)
      throw_user_error({"grading", what, fmt::format("{:g} %", 100 * finer), "be between 0 and 100 %", ""});
    if (i > 0 && finer < points[i - 1].finer)
      throw_user_error(
          {"grading", what, fmt::format("{:g} %", 100 * finer),
           fmt::format("not be below that of the size before it, {:g} %", 100 * points[i - 1].finer),
           "give the cumulative curve"});
  }
  const double total = points.back().finer;
  if (std::abs(total - 1) > 5e-3)
    throw_user_error({"grading", "share finer than the largest size", fmt::format("{:g} %", 100 * total),
                      "be 100 % (within 0.5)", "add the size that all grains pass"});
  Grading grading;
  for (const GradingPoint& point : points) grading.curve_.push_back({point.diameter, point.finer / total});
  // No grains above the first point that all pass, nor below the last that none passes.
  while (grading.curve_.size() > 1 && grading.curve_[grading.curve_.size() - 2].finer >= 1)
    grading.curve_.pop_back();
  while (grading.curve_.size() > 1 && grading.curve_[1].finer <= 0)
    grading.curve_.erase(grading.curve_.begin());
  if (grading.curve_.front().finer >= 1)
    throw_user_error({"grading", "share finer than the smallest size", "100 %", "be below 100 %",
                      "give sizes that some grains are finer than"});
  grading.unknown_below_ = grading.curve_.front().finer;
  grading.gap_ = widest_gap(grading.curve_, rule);
  return grading;
}

Grading Grading::from_grains(std::span<const double> diameters, const GapRule& rule) {
  std::vector<double> sorted(diameters.begin(), diameters.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<GradingClass> classes;
  double first_of_class = 0;
  for (const double diameter : sorted) {
    if (!is_positive(diameter))
      throw_user_error(
          {"grading", "diameter of a grain", fmt::format("{:g} m", diameter), "be positive and finite", ""});
    if (classes.empty() || diameter > first_of_class * (1 + 1e-6)) {
      classes.push_back({diameter, 0});
      first_of_class = diameter;
    }
    classes.back().mass += diameter * diameter * diameter;
  }
  const Grading all = from_classes(classes, rule);
  return classes.size() <= kMostSizes ? all : from_classes(all.classes(kMostSizes), rule);
}

double Grading::diameter_at(double finer) const {
  const auto point = std::partition_point(curve_.begin(), curve_.end(),
                                          [&](const GradingPoint& p) { return p.finer < finer - kRounding; });
  if (std::isnan(finer) || finer < unknown_below_ - kRounding) return kUnknown;
  if (point == curve_.begin()) return curve_.front().diameter;
  if (point == curve_.end()) return curve_.back().diameter;
  return log_between(std::min(finer, point->finer), *(point - 1), *point);
}

double Grading::diameter_above(double finer) const {
  const auto point = std::partition_point(
      curve_.begin(), curve_.end(), [&](const GradingPoint& p) { return p.finer <= finer + kRounding; });
  if (std::isnan(finer) || finer < unknown_below_ - kRounding) return kUnknown;
  if (point == curve_.begin()) return curve_.front().diameter;
  if (point == curve_.end()) return curve_.back().diameter;
  return log_between(std::max(finer, (point - 1)->finer), *(point - 1), *point);
}

double Grading::finer_at(double diameter) const {
  if (std::isnan(diameter)) return kUnknown;
  if (diameter >= curve_.back().diameter) return 1;
  const auto above = std::upper_bound(curve_.begin(), curve_.end(), diameter,
                                      [](double d, const GradingPoint& p) { return d < p.diameter; });
  if (above == curve_.begin()) return unknown_below_ > 0 ? kUnknown : 0;
  const GradingPoint &low = *(above - 1), &high = *above;
  return between(std::log(diameter), std::log(low.diameter), std::log(high.diameter), low.finer, high.finer);
}

double Grading::finer_below(double diameter) const {
  if (std::isnan(diameter)) return kUnknown;
  if (diameter > curve_.back().diameter) return 1;
  const auto above = std::lower_bound(curve_.begin(), curve_.end(), diameter,
                                      [](const GradingPoint& p, double d) { return p.diameter < d; });
  if (above == curve_.begin() && unknown_below_ > 0)
    return diameter == curve_.front().diameter ? unknown_below_ : kUnknown;
  if (above == curve_.begin()) return 0;
  const GradingPoint &low = *(above - 1), &high = *above;
  return between(std::log(diameter), std::log(low.diameter), std::log(high.diameter), low.finer, high.finer);
}

std::vector<GradingClass> Grading::classes(std::size_t most) const {
  if (!classes_.empty() && classes_.size() <= most) return classes_;
  if (unknown_below_ > 0)
    throw_user_error({"grading", "percent_finer of the smallest size",
                      fmt::format("{:g} %", 100 * unknown_below_),
                      fmt::format("be 0 for this ({})", curve_end(*this)),
                      "add the size than which no grain is finer, with 0"});
  std::vector<GradingClass> result;
  const double share = 1.0 / static_cast<double>(most);
  for (std::size_t i = 0; i < most; ++i) {
    const double diameter = diameter_at((static_cast<double>(i) + 0.5) * share);
    if (!result.empty() && diameter <= result.back().diameter * (1 + kRounding))
      result.back().mass += share;
    else
      result.push_back({diameter, share});
  }
  return result;
}

double effective_diameter(std::span<const GradingClass> classes) {
  double mass = 0, surface = 0;
  for (const GradingClass& one : classes) {
    mass += one.mass;
    surface += one.mass / one.diameter;
  }
  return mass / surface;
}

std::string curve_end(const Grading& grading) {
  return fmt::format("the curve ends at {:.4g} mm with {:.3g} % finer", 1e3 * grading.smallest(),
                     100 * grading.unknown_below());
}

GradingIndices grading_indices(const Grading& grading) {
  const auto d = [&](double finer) { return grading.diameter_at(finer); };
  GradingIndices indices{d(0.05), d(0.10), d(0.15), d(0.20), d(0.30), d(0.50), d(0.60), d(0.85), d(0.90)};
  indices.uniformity = indices.d60 / indices.d10;
  indices.curvature = indices.d30 * indices.d30 / (indices.d10 * indices.d60);
  indices.sauter = grading.unknown_below() > 0 ? kUnknown : effective_diameter(grading.classes(200));
  return indices;
}

std::vector<ShapePoint> shape_curve(const Grading& grading, double finer_limit) {
  std::vector<double> corners;
  for (const GradingPoint& point : grading.curve()) {
    corners.push_back(point.diameter);
    if (point.diameter / 4 >= grading.smallest()) corners.push_back(point.diameter / 4);
  }
  if (finer_limit >= grading.unknown_below()) corners.push_back(grading.diameter_at(finer_limit));
  std::sort(corners.begin(), corners.end());
  std::vector<ShapePoint> result;
  const auto add = [&](double diameter, double finer, double finer_of_four) {
    const bool known = !result.empty() && result.back().diameter == diameter &&
                       result.back().finer == finer && result.back().interval == finer_of_four - finer;
    if (finer <= finer_limit + kRounding && !known)
      result.push_back({diameter, finer, finer_of_four - finer});
  };
  for (const double diameter : corners) {
    // Where the curve jumps at d or at 4d, H has a value on either side.
    add(diameter, grading.finer_below(diameter), grading.finer_below(4 * diameter));
    add(diameter, grading.finer_at(diameter), grading.finer_below(4 * diameter));
    add(diameter, grading.finer_at(diameter), grading.finer_at(4 * diameter));
  }
  return result;
}

std::pair<std::vector<GradingClass>, std::vector<GradingClass>> split_classes(
    std::span<const GradingClass> classes, double finer) {
  if (!(finer > 0 && finer < 1))
    throw_user_error(
        {"grading", "share finer at the split", fmt::format("{:g}", finer), "be between 0 and 1", ""});
  std::vector<GradingClass> fine, coarse;
  double passed = 0;
  for (const GradingClass& one : classes) {
    const double to_fine = std::clamp(finer - passed, 0.0, one.mass);
    if (to_fine > kRounding) fine.push_back({one.diameter, to_fine / finer});
    if (one.mass - to_fine > kRounding) coarse.push_back({one.diameter, (one.mass - to_fine) / (1 - finer)});
    passed += one.mass;
  }
  return {fine, coarse};
}

}  // namespace suffuse::micromechanics
