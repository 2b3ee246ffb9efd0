#include "suffuse/micromechanics/sphere_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "suffuse/micromechanics/coordination.h"

namespace suffuse::micromechanics {
namespace {

using std::numbers::pi;

/// Area of the part of a circle at the origin with X ≤ x, for |x| ≤ r.
double circle_area_below(double radius, double x) {
  return radius * radius * (pi / 2 + std::asin(x / radius)) +
         x * std::sqrt(std::max(0.0, radius * radius - x * x));
}

/// Area of the part of a circle at the origin with X ≤ x and Y ≤ y.
double circle_area_in_quadrant(double radius, double x, double y) {
  x = std::clamp(x, -radius, radius);
  y = std::clamp(y, -radius, radius);
  const double below_x = circle_area_below(radius, x);
  const double below_y = circle_area_below(radius, y);
  const double whole = pi * radius * radius;
  if (x * x + y * y < radius * radius) return (below_x + below_y) / 2 - whole / 4 + x * y;
  if (x >= 0 && y >= 0) return below_x + below_y - whole;
  if (x < 0 && y < 0) return 0;
  return x < 0 ? below_x : below_y;
}

/// Limits of a rectangle, from the circle's centre.
struct Rectangle {
  double x_low, x_high, y_low, y_high;
};

double circle_area_in_rectangle(double radius, const Rectangle& cut) {
  if (radius <= 0) return 0;
  return circle_area_in_quadrant(radius, cut.x_high, cut.y_high) -
         circle_area_in_quadrant(radius, cut.x_low, cut.y_high) -
         circle_area_in_quadrant(radius, cut.x_high, cut.y_low) +
         circle_area_in_quadrant(radius, cut.x_low, cut.y_low);
}

struct GaussRule {
  static constexpr int kPoints = 16;
  std::array<double, kPoints> node{}, weight{};  // on [0, 1]

  GaussRule() {
    for (int i = 0; i < kPoints; ++i) {
      double x = std::cos(pi * (i + 0.75) / (kPoints + 0.5)), slope = 1;
      for (int iteration = 0; iteration < 20; ++iteration) {
        double previous = 1, legendre = x;
        for (int degree = 2; degree <= kPoints; ++degree) {
          const double next = ((2 * degree - 1) * x * legendre - (degree - 1) * previous) / degree;
          previous = legendre;
          legendre = next;
        }
        slope = kPoints * (x * legendre - previous) / (x * x - 1);
        x -= legendre / slope;
      }
      node[static_cast<std::size_t>(i)] = (1 + x) / 2;
      weight[static_cast<std::size_t>(i)] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

/// Heights at which the area of circle and rectangle changes its form, within [low, high], sorted.
std::vector<double> break_points(double radius, const Rectangle& cut, double low, double high) {
  std::vector<double> points{low, high};
  const auto add = [&](double distance_squared) {
    const double height_squared = radius * radius - distance_squared;
    if (!(height_squared > 0)) return;
    for (const double height : {-std::sqrt(height_squared), std::sqrt(height_squared)})
      if (height > low && height < high) points.push_back(height);
  };
  for (const double x : {cut.x_low, cut.x_high}) {
    add(x * x);
    for (const double y : {cut.y_low, cut.y_high}) add(x * x + y * y);
  }
  for (const double y : {cut.y_low, cut.y_high}) add(y * y);
  std::sort(points.begin(), points.end());
  return points;
}

double integrate_sections(double radius, const Rectangle& cut, double low, double high) {
  static const GaussRule rule;
  const std::vector<double> points = break_points(radius, cut, low, high);
  double volume = 0;
  for (std::size_t piece = 1; piece < points.size(); ++piece) {
    const double start = points[piece - 1], length = points[piece] - start;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      // The area has square-root ends; the substitution 3t² − 2t³ makes it smooth.
      const double t = rule.node[i];
      const double height = start + length * t * t * (3 - 2 * t);
      const double section = std::sqrt(std::max(0.0, radius * radius - height * height));
      volume += rule.weight[i] * length * 6 * t * (1 - t) * circle_area_in_rectangle(section, cut);
    }
  }
  return volume;
}

}  // namespace

double sphere_volume_below(double radius, double height) {
  if (height <= -radius) return 0;
  if (height >= radius) return sphere_volume(radius);
  return pi * (radius + height) * (radius + height) * (2 * radius - height) / 3;
}

double sphere_volume_in_box(const Vec3& centre, double radius, const Box& box) {
  const Vec3 low = (box.low - centre).cwiseMax(-radius).cwiseMin(radius);
  const Vec3 high = (box.high - centre).cwiseMax(-radius).cwiseMin(radius);
  std::array<int, 3> cut{};
  int cuts = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] <= low[axis]) return 0;
    if (low[axis] > -radius || high[axis] < radius) cut[static_cast<std::size_t>(cuts++)] = axis;
  }
  if (cuts == 0) return sphere_volume(radius);
  if (cuts == 1) return sphere_volume_below(radius, high[cut[0]]) - sphere_volume_below(radius, low[cut[0]]);
  const int along = cut[0], x = (along + 1) % 3, y = (along + 2) % 3;
  return integrate_sections(radius, {low[x], high[x], low[y], high[y]}, low[along], high[along]);
}

}  // namespace suffuse::micromechanics
