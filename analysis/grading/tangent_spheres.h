#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <vector>

#include "grading/sphere_grid.h"
#include "suffuse/common/linear_algebra.h"

namespace suffuse::analysis {

constexpr double kTouch = 1e-9;  // of a radius: tangent, but for round-off

struct VoidSphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

struct Circle {
  Eigen::Vector2d centre;
  double radius = 0;
};

/// Sphere outside of four grains that touches them all; none for four grains nearly in a plane and the like.
std::optional<VoidSphere> tangent_sphere(const std::array<const Sphere*, 4>& grains);

/// Whether two circles overlap by round-off at most.
bool are_apart(const Circle& one, const Circle& other);

/// The disc between the three grains of a face, in its plane; none where they overlap too much.
std::optional<Circle> disc_between(const std::array<Circle, 3>& corners);

/// Where others intrude: the largest free disc with its centre in the face that touches three of all grains.
/// `around`: every grain that comes near the face.
std::optional<Circle> disc_beside_intruders(const std::array<Circle, 3>& corners,
                                            const std::vector<Circle>& around);

}  // namespace suffuse::analysis
