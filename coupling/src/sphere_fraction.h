#pragma once

/// Which part of a cell a sphere covers, for eight neighbouring cells at a time, or for those of two rows.
/// Lengths in cells.

#include "suffuse/coupling/mapped_sphere.h"
#include "suffuse/simd/eight_floats.h"

namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE {

using namespace simd::SUFFUSE_KERNEL_NAMESPACE;

template <class V>
[[gnu::always_inline]] inline V positive_cubed(const V& v) {
  const V p = greater(v, V{});
  return p * p * p;
}

/// Half of a cell's diagonal: beyond radius + this nothing is covered, within radius - this all is.
inline constexpr float kHalfDiagonal = 0.8660255f;

/// Below this radius a cell is cut into smaller ones for the plane cut, until its radius is at least this in
/// them.
inline constexpr float kLeastRadius = 2.f;

/// But into no more than this cubed: of smaller spheres, below a fifth of a cell across, little or nothing is
/// left, and their volume would not be felt either.
inline constexpr int kMostParts = 20;

/// What is the same for all cells of a sphere.
struct Sphere {
  float radius;
  float linear_offset;  ///< see linear_offset()
  int parts;            ///< cells are cut into parts^3
};

/// Part of a cube of edge 1 with its centre at (x, y, z) from the centre of a sphere, by the plane through
/// the sphere's surface nearest to the cube's centre, moved inwards by the mean depth of the surface below it
/// (t^2/2r, with the mean square distance t^2 in the cut taken from its orientation). The volume under a
/// plane is Scardovelli and Zaleski's (docs key: scardovelli2000).
template <class V>
[[gnu::always_inline]] inline V plane_cut(const V& x, const V& y, const V& z, float radius) {
  const V distance = square_root(x * x + y * y + z * z);
  const V inverse = 1.f / greater(distance, V{} + 1e-6f);
  // Normals parallel to a face divide by zero below; turned by this little they change the fraction by its
  // square.
  constexpr float least = 0.02f;
  const V nx = greater(magnitude(x) * inverse, V{} + least),
          ny = greater(magnitude(y) * inverse, V{} + least),
          nz = greater(magnitude(z) * inverse, V{} + least);
  const V sum = nx + ny + nz, product = nx * ny * nz;
  // Mean of t^2 over the cut through the middle: 1/6 for a face, 5/24 for the hexagon across a diagonal.
  const float inverse_radius = 1 / radius;
  const V curvature = (inverse_radius / 12) + ((27.f / 48) * inverse_radius) * (product * product);
  const V offset = 0.5f * sum - (distance - radius) - curvature;  // along the normal, from the nearest corner
  const V whole = offset > 0.5f * sum ? V{} + 1.f : V{};
  const V low = lesser(offset, sum - offset);
  const V largest = greater(nx, greater(ny, nz));
  const V per_volume = 1.f / (6.f * product);  // long before it is needed
  const V volume = (positive_cubed(low) - positive_cubed(low - nx) - positive_cubed(low - ny) -
                    positive_cubed(low - nz) + positive_cubed(low - (sum - largest))) *
                   per_volume;
  return whole > 0.f ? 1.f - volume : volume;
}

template <FractionMethod kMethod, class V>
[[gnu::always_inline]] inline V covered(const Sphere& sphere, const V& dx, const V& dy, float dz) {
  const V squared = dx * dx + (dy * dy + dz * dz);
  if constexpr (kMethod == FractionMethod::linear) {
    const V fraction = (sphere.linear_offset + sphere.radius) - square_root(squared);
    return lesser(greater(fraction, V{}), V{} + 1.f);
  }
  const float inside = sphere.radius - kHalfDiagonal, outside = sphere.radius + kHalfDiagonal;
  const V in = inside > 0 ? (squared < inside * inside ? V{} + 1.f : V{}) : V{};
  const V out = squared > outside * outside ? V{} + 1.f : V{};
  if (!any(1.f - (in + out))) return in;
  V fraction{};
  if constexpr (kMethod == FractionMethod::exact) {
    if (sphere.radius >= kLeastRadius) {
      fraction = plane_cut(dx, dy, V{} + dz, sphere.radius);
    } else {
      const float wanted = kLeastRadius / sphere.radius + 1.f;
      const int n = wanted < static_cast<float>(kMostParts) ? static_cast<int>(wanted) : kMostParts;
      const float scale = static_cast<float>(n);
      for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            const auto at = [&](int part) { return static_cast<float>(part) + 0.5f - 0.5f * scale; };
            const V x = scale * dx + at(i), y = scale * dy + at(j), z = V{} + (scale * dz + at(k));
            const float r = scale * sphere.radius;
            const V d2 = x * x + y * y + z * z;
            const float near = r - kHalfDiagonal, far = r + kHalfDiagonal;
            const V cut = lesser(greater(plane_cut(x, y, z, r), V{}), V{} + 1.f);
            fraction += d2 < near * near ? V{} + 1.f : (d2 > far * far ? V{} : cut);
          }
      fraction /= scale * scale * scale;
    }
    fraction = lesser(greater(fraction, V{}), V{} + 1.f);
  } else {
    const float part = 1.f / static_cast<float>(sphere.parts), square = sphere.radius * sphere.radius;
    V points{};
    float z = dz + (0.5f * part - 0.5f);
    for (int k = 0; k < sphere.parts; ++k, z += part) {
      V y = dy + (0.5f * part - 0.5f);
      for (int j = 0; j < sphere.parts; ++j, y += part) {
        const V across = square - (y * y + z * z);
        V x = dx + (0.5f * part - 0.5f), in_line{};  // its own sum: kept in a register
        for (int i = 0; i < sphere.parts; ++i, x += part) in_line += x * x < across ? V{} + 1.f : V{};
        points += in_line;
      }
    }
    fraction = points * (part * part * part);
  }
  return in > 0.f ? in : (out > 0.f ? V{} : fraction);
}

}  // namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE
