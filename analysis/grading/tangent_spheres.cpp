#include "grading/tangent_spheres.h"

#include <algorithm>
#include <cmath>

namespace suffuse::analysis {

namespace {

/// A tetrahedron of less volume (times 6, of the product of three edges) is flat: where the sphere that
/// touches its four grains has its centre says nothing about pores.
constexpr double kFlat = 1e-3;

/// Discs outside of three circles that touch all three.
std::vector<Circle> tangent_circles(const Circle& first, const Circle& second, const Circle& third) {
  Eigen::Matrix2d matrix;
  Eigen::Vector2d constant, linear;
  for (int row = 0; row < 2; ++row) {
    const Circle& other = row == 0 ? second : third;
    const Eigen::Vector2d apart = other.centre - first.centre;
    matrix.row(row) = 2 * apart.transpose();
    constant[row] = apart.squaredNorm() - other.radius * other.radius + first.radius * first.radius;
    linear[row] = -2 * (other.radius - first.radius);
  }
  const double scale = matrix.row(0).norm() * matrix.row(1).norm();
  if (std::abs(matrix.determinant()) < 1e-12 * scale) return {};
  const Eigen::Vector2d p = matrix.inverse() * constant, q = matrix.inverse() * linear;
  const double a = q.squaredNorm() - 1, b = 2 * (p.dot(q) - first.radius),
               c = p.squaredNorm() - first.radius * first.radius;
  std::vector<Circle> found;
  const auto add = [&](double radius) {
    if (radius > 0) found.push_back({first.centre + p + q * radius, radius});
  };
  if (std::abs(a) < 1e-12) {
    if (b != 0) add(-c / b);
  } else if (const double discriminant = b * b - 4 * a * c; discriminant >= 0) {
    add((-b - std::sqrt(discriminant)) / (2 * a));
    add((-b + std::sqrt(discriminant)) / (2 * a));
  }
  return found;
}

bool inside(const Eigen::Vector2d& point, const std::array<Circle, 3>& corners, double tolerance) {
  const auto side = [&](std::size_t i, std::size_t j) {
    const Eigen::Vector2d edge = corners[j].centre - corners[i].centre, to = point - corners[i].centre;
    return (edge.x() * to.y() - edge.y() * to.x()) / edge.norm();
  };
  const double one = side(0, 1), two = side(1, 2), three = side(2, 0);
  return (one >= -tolerance && two >= -tolerance && three >= -tolerance) ||
         (one <= tolerance && two <= tolerance && three <= tolerance);
}

}  // namespace

std::optional<VoidSphere> tangent_sphere(const std::array<const Sphere*, 4>& grains) {
  // |x − c_i| = r + R_i; less the first equation: 2(c_i − c_0)·x + 2(R_i − R_0) r = |c_i|² − |c_0|² − R_i² +
  // R_0², about c_0, so x = p + q r, then a quadratic for r.
  Mat3 matrix;
  Vec3 constant, linear;
  for (int row = 0; row < 3; ++row) {
    const Sphere& other = *grains[static_cast<std::size_t>(row) + 1];
    const Vec3 apart = other.centre - grains[0]->centre;
    matrix.row(row) = 2 * apart.transpose();
    constant[row] = apart.squaredNorm() - other.radius * other.radius + grains[0]->radius * grains[0]->radius;
    linear[row] = -2 * (other.radius - grains[0]->radius);
  }
  const double edges = matrix.row(0).norm() * matrix.row(1).norm() * matrix.row(2).norm();
  if (std::abs(matrix.determinant()) < kFlat * edges) return std::nullopt;
  const Eigen::PartialPivLU<Mat3> factors(matrix);
  const Vec3 p = factors.solve(constant), q = factors.solve(linear);
  const double own = grains[0]->radius;
  const double a = q.squaredNorm() - 1, b = 2 * (p.dot(q) - own), c = p.squaredNorm() - own * own;
  double radius = -1;
  if (std::abs(a) < 1e-12) {
    if (b != 0) radius = -c / b;
  } else {
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return std::nullopt;
    const double root = std::sqrt(discriminant);
    for (const double candidate : {(-b - root) / (2 * a), (-b + root) / (2 * a)})
      if (candidate > 0 && (radius < 0 || candidate < radius)) radius = candidate;
  }
  if (!(radius > 0)) return std::nullopt;
  return VoidSphere{grains[0]->centre + p + q * radius, radius};
}

bool are_apart(const Circle& one, const Circle& other) {
  return (one.centre - other.centre).norm() >= (one.radius + other.radius) * (1 - kTouch);
}

std::optional<Circle> disc_between(const std::array<Circle, 3>& corners) {
  const std::vector<Circle> found = tangent_circles(corners[0], corners[1], corners[2]);
  if (found.empty()) return std::nullopt;
  return *std::min_element(found.begin(), found.end(),
                           [](const Circle& a, const Circle& b) { return a.radius < b.radius; });
}

std::optional<Circle> disc_beside_intruders(const std::array<Circle, 3>& corners,
                                            const std::vector<Circle>& around) {
  std::vector<Circle> circles(corners.begin(), corners.end());
  circles.insert(circles.end(), around.begin(), around.end());
  std::optional<Circle> best;
  for (std::size_t i = 0; i < circles.size(); ++i)
    for (std::size_t j = i + 1; j < circles.size(); ++j)
      for (std::size_t k = j + 1; k < circles.size(); ++k)
        for (const Circle& disc : tangent_circles(circles[i], circles[j], circles[k]))
          if ((!best || disc.radius > best->radius) &&
              inside(disc.centre, corners, kTouch * corners[0].radius) &&
              std::all_of(circles.begin(), circles.end(),
                          [&](const Circle& circle) { return are_apart(disc, circle); }))
            best = disc;
  return best;
}

}  // namespace suffuse::analysis
