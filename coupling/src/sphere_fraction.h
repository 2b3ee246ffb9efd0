#pragma once

/// Which part of a cell a sphere covers, for eight neighbouring cells at a time, or for those of two rows.
/// Lengths in cells.

#include "suffuse/coupling/mapped_sphere.h"
#include "suffuse/simd/eight_floats.h"

namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE {

using namespace simd::SUFFUSE_KERNEL_NAMESPACE;

/// Half of a cell's diagonal: beyond radius + this nothing is covered, within radius - this all is.
inline constexpr float kHalfDiagonal = 0.8660255f;

/// Below this radius a cell is cut into smaller ones for the plane cut, until its radius is at least this in
/// them.
inline constexpr float kLeastRadius = 1.5f;

/// But into no more than this cubed: of smaller spheres, below a fifth of a cell across, little or nothing is
/// left, and their volume would not be felt either.
inline constexpr int kMostParts = 20;

/// What is the same for all cells of a sphere.
struct Sphere {
  float radius;
  float linear_offset;  ///< see linear_offset()
  int parts;            ///< cells are cut into parts^3
};

/// Part of a cube of edge 1 with its centre at (x, y, z) from the centre of a sphere: what is behind the
/// plane that touches the sphere nearest to the cube's centre, less what lies between the two. Volume and
/// section of the cube behind a plane are Scardovelli and Zaleski's (docs key: scardovelli2000). Between
/// plane and sphere is the integral of t^2/2r over the section, t the distance from the point of contact: the
/// mean of t^2 is 0.06 + 0.12 times the section's area, fitted to cuts in all directions (a face has 1/6, the
/// hexagon across a diagonal 5/24, less towards corners). The plane is moved inwards by half of a face's 1/6
/// beforehand, and the section taken there. Fractions err by 0.0029 (rms) at a radius of 1.5, 0.0017 at 2,
/// 0.0006 at 6.
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
  constexpr float shift = 1.f / 12;
  const float inverse_radius = 1 / radius;
  // Along the normal, from the nearest corner
  const V offset = 0.5f * sum - (distance - radius) - shift * inverse_radius;
  const V whole = offset > 0.5f * sum ? V{} + 1.f : V{};
  const V low = lesser(offset, sum - offset);
  const V largest = greater(nx, greater(ny, nz));
  const V per_product = 1.f / product;  // long before it is needed
  const V all = greater(low, V{}), off_x = greater(low - nx, V{}), off_y = greater(low - ny, V{}),
          off_z = greater(low - nz, V{}), twice_off = greater(low - (sum - largest), V{});
  const V all2 = all * all, off_x2 = off_x * off_x, off_y2 = off_y * off_y, off_z2 = off_z * off_z,
          twice_off2 = twice_off * twice_off;
  const V area = (all2 - off_x2 - off_y2 - off_z2 + twice_off2) * (0.5f * per_product);
  const V volume = (all2 * all - off_x2 * off_x - off_y2 * off_y - off_z2 * off_z + twice_off2 * twice_off) *
                   ((1.f / 6) * per_product);
  const V between = area * (0.06f * area - (shift - 0.03f)) * inverse_radius;
  return (whole > 0.f ? 1.f - volume : volume) - between;
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
