#include "suffuse/micromechanics/grain_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/coordination.h"

namespace suffuse::micromechanics {
namespace {

constexpr double kAllGrains = 0.504891, kLargeGrains = 0.7 * kAllGrains, kLargeFrom = 1 / 2.7;
constexpr double kFewGrains = 15000, kRoomOfFew = 1.1;

/// `count` classes of equal mass between two shares of the curve.
void add_classes(const Grading& grading, double from, double to, std::size_t count,
                 std::vector<GradingClass>& classes) {
  const double share = (to - from) / static_cast<double>(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double diameter = grading.diameter_at(from + (static_cast<double>(k) + 0.5) * share);
    if (!classes.empty() && diameter <= classes.back().diameter * (1 + 1e-9))
      classes.back().mass += share;
    else
      classes.push_back({diameter, share});
  }
}

double volume_of(double diameter) {
  return sphere_volume(diameter / 2);
}

double numbers_per_volume(std::span<const GradingClass> classes) {
  double numbers = 0;
  for (const GradingClass& one : classes) numbers += one.mass / volume_of(one.diameter);
  return numbers;
}

}  // namespace

std::vector<GradingClass> sample_classes(const Grading& grading, std::size_t most) {
  if (most < 2) throw_user_error({"sample", "classes", fmt::format("{}", most), "be at least 2", ""});
  std::vector<GradingClass> classes = grading.classes(most);  // throws where the curve is not known whole
  const bool own = classes.size() <= most && classes == grading.own_classes();
  if (own || !grading.gap()) return classes;
  const double fines = grading.gap()->finer;
  const double of_fines = std::round(fines * static_cast<double>(most));
  const std::size_t fine = static_cast<std::size_t>(std::clamp(of_fines, 1.0, static_cast<double>(most - 1)));
  classes.clear();
  add_classes(grading, 0, fines, fine, classes);
  add_classes(grading, fines, 1, most - fine, classes);
  return classes;
}

CutGrading cut_below(const Grading& grading, double smallest) {
  const auto too_coarse = [&] {
    throw_user_error(
        {"sample", "--smallest", fmt::format("{:.4g} mm", 1e3 * smallest),
         fmt::format("leave more than one size of a grading up to {:.4g} mm", 1e3 * grading.largest()), ""});
  };
  if (!grading.own_classes().empty()) {
    std::vector<GradingClass> left;
    double lost = 0;
    for (const GradingClass& one : grading.own_classes())
      if (one.diameter < smallest)
        lost += one.mass;
      else
        left.push_back(one);
    if (left.size() < 2) too_coarse();
    return {Grading::from_classes(left), lost};
  }
  if (smallest <= grading.smallest() && grading.unknown_below() == 0) return {grading, 0};
  if (smallest >= grading.largest()) too_coarse();
  const double lost = grading.finer_at(smallest);
  if (std::isnan(lost))
    throw_user_error({"sample", "--smallest", fmt::format("{:.4g} mm", 1e3 * smallest),
                      fmt::format("not lie below the curve: {}", curve_end(grading)), ""});
  std::vector<GradingPoint> points{{smallest, 0}};
  for (const GradingPoint& point : grading.curve())
    if (point.diameter > smallest * (1 + 1e-9))
      points.push_back({point.diameter, (point.finer - lost) / (1 - lost)});
  return {Grading::from_curve(points), lost};
}

GrainSample grain_sample(std::span<const GradingClass> classes, double grains, double split) {
  GrainSample sample;
  sample.split = split;
  sample.grains = grains;
  const double all = numbers_per_volume(classes);
  for (const GradingClass& one : classes) {
    const double number = grains * one.mass / volume_of(one.diameter) / all;
    sample.classes.push_back({one.diameter, one.mass, number});
    sample.solids += number * volume_of(one.diameter);
    if (one.diameter < split)
      sample.fines_share += one.mass;
    else
      sample.coarse += number;
  }
  return sample;
}

std::vector<std::size_t> whole_numbers(const GrainSample& sample) {
  std::vector<std::size_t> numbers, order;
  std::size_t left = static_cast<std::size_t>(std::round(sample.grains));
  for (const SampleClass& one : sample.classes) {
    order.push_back(numbers.size());
    numbers.push_back(static_cast<std::size_t>(one.grains));
    left -= std::min(left, numbers.back());
  }
  const auto remainder = [&](std::size_t k) {
    return sample.classes[k].grains - static_cast<double>(numbers[k]);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return remainder(a) > remainder(b); });
  for (const std::size_t k : order) {
    if (left == 0) break;
    ++numbers[k];
    --left;
  }
  return numbers;
}

double grains_with_coarse(std::span<const GradingClass> classes, double coarse, double split) {
  const double share = grain_sample(classes, 1, split).coarse;
  return share > 0 ? coarse / share : std::numeric_limits<double>::infinity();
}

double grains_with_every_size(std::span<const GradingClass> classes) {
  double sum = 0, least = std::numeric_limits<double>::infinity();
  for (const GradingClass& one : classes) {
    const double number = one.mass / std::pow(one.diameter, 3);
    sum += number;
    least = std::min(least, number);
  }
  return sum / least;
}

double placing_solid_fraction(std::span<const GradingClass> classes) {
  double large = 0, all = 0;
  for (const GradingClass& one : classes) {
    all += one.mass;
    if (one.diameter >= classes.back().diameter * kLargeFrom) large += one.mass;
  }
  return std::min(kAllGrains, kLargeGrains * all / large);
}

double placing_box_edge(const GrainSample& sample, double solid_fraction) {
  return std::cbrt(sample.solids / solid_fraction) * (sample.grains < kFewGrains ? kRoomOfFew : 1);
}

}  // namespace suffuse::micromechanics
