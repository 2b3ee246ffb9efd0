// Compiled once for each instruction set, as mapping_kernels.cpp.
#include "pore_kernels.h"

#include "suffuse/simd/eight_floats.h"

namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE {

using namespace simd::SUFFUSE_KERNEL_NAMESPACE;

namespace {

/// Adding and subtracting this rounds to multiples of 2^-20 as long as sums stay below 16: exact in any
/// order.
constexpr float kRounding = 12.f;

/// Which cells of a row, or rows, or planes, have their centre within `reach` of `position`.
struct Range {
  int begin, end;
  Range(double position, double reach, int lo, int cells) {
    const double first = __builtin_ceil(position - reach - 0.5) - lo;
    const double last = __builtin_floor(position + reach - 0.5) - lo + 1;
    begin = first > 0 ? (first < cells ? static_cast<int>(first) : cells) : 0;
    end = last > 0 ? (last < cells ? static_cast<int>(last) : cells) : 0;
  }
};

/// Calls visit(y, z, x range, dy^2 + dz^2) for the rows that a ball reaches.
template <class Visit>
[[gnu::always_inline]] inline void for_rows(const double* position, double reach, const PoreCells& cells,
                                            const Visit& visit) {
  const Range zs(position[2], reach, cells.lo[2], cells.cells[2]);
  for (int z = zs.begin; z < zs.end; ++z) {
    const double dz = z + cells.lo[2] + 0.5 - position[2], left = reach * reach - dz * dz;
    if (left <= 0) continue;
    const Range ys(position[1], __builtin_sqrt(left), cells.lo[1], cells.cells[1]);
    for (int y = ys.begin; y < ys.end; ++y) {
      const double dy = y + cells.lo[1] + 0.5 - position[1], rest = left - dy * dy;
      if (rest <= 0) continue;
      const Range xs(position[0], __builtin_sqrt(rest), cells.lo[0], cells.cells[0]);
      if (xs.begin < xs.end) visit(y, z, xs, dy * dy + dz * dz);
    }
  }
}

/// From the centre, for eight cells; the same whichever pack a cell is in.
[[gnu::always_inline]] inline Floats distances(int x, const PoreCells& cells, double centre) {
  const Doubles lanes = __builtin_convertvector(kLaneNumbers, Doubles);
  return __builtin_convertvector((lanes + (x + cells.lo[0] + 0.5)) - centre, Floats);
}

[[gnu::always_inline]] inline Floats first_lanes(int count) {
  return kLaneNumbers < static_cast<float>(count) ? Floats{} + 1.f : Floats{};
}

/// A unit sphere seen through the window w = (15/8 pi) (1 - t^2), t < 1 the distance from the place of
/// interest, whose distance from the sphere's centre is q < 2. Integrals over shells of that t: of
/// w over the sphere's surface, and of w over its inside.
struct Smoothed {
  Floats surface, solid;
};
[[gnu::always_inline]] inline Smoothed smoothed(const Floats& distance) {
  constexpr float pi = 3.14159265f, scale = 15 / (8 * pi);
  const Floats q = greater(distance, Floats{} + 0.05f), inverse = 1.f / q;
  const Floats l = magnitude(q - 1.f), l2 = l * l, l4 = l2 * l2;
  // The surface lies in shells from l to 1: 2 pi/q times the integral of w t.
  const Floats ring = 0.25f - (0.5f * l2 - 0.25f * l4);
  // The part of a shell that is inside is a cap, of 1 - (q^2 + t^2 - 1)/(2 q t) times a half of it.
  const Floats whole = l * l2 * (1.f / 3) - l * l4 * 0.2f;  // integral of w t^2 up to l
  const Floats caps = (2.f / 15 - whole) * (2 * pi) -
                      inverse * pi * ((q * q - 1.f) * ring + (1.f / 12 - (0.25f * l4 - l4 * l2 * (1.f / 6))));
  const Floats core = q < 1.f ? (4 * pi) * whole : Floats{};
  return {scale * 2 * pi * inverse * ring, scale * (caps + core)};
}

}  // namespace

void add_smoothed(const double* position, double radius, const PoreCells& cells) {
  const float per_radius = static_cast<float>(1 / radius);
  for_rows(position, 2 * radius, cells, [&](int y, int z, const Range& xs, double rest) {
    const std::ptrdiff_t row = cells.row_pitch * y + cells.plane_pitch * z;
    const Floats other = Floats{} + static_cast<float>(rest);
    for (int x = xs.begin; x < xs.end; x += kLanes) {
      const Floats dx = distances(x, cells, position[0]);
      const Floats q = square_root(dx * dx + other) * per_radius;
      const Floats in = q < 2.f ? first_lanes(xs.end - x) : Floats{};
      const Smoothed sphere = smoothed(lesser(q, Floats{} + 2.f));
      const Floats surface = (in * sphere.surface * per_radius + kRounding) - kRounding;
      const Floats solid = (in * sphere.solid + kRounding) - kRounding;
      store(cells.surface + row + x, load(cells.surface + row + x) + surface);
      store(cells.solid + row + x, load(cells.solid + row + x) + solid);
    }
  });
}

void narrow_plane(const PoreCells& cells, const PoreTerms& terms, int z) {
  for (int y = 0; y < cells.cells[1]; ++y) {
    const std::ptrdiff_t row = cells.row_pitch * y + cells.plane_pitch * z;
    for (int x = 0; x < cells.cells[0]; x += kLanes) {
      const Floats open = greater(1.f - load(cells.solid + row + x), Floats{}) + terms.open;
      const Floats ratio = load(cells.surface + row + x) / open;
      store(cells.surface + row + x, ratio * (terms.linear + terms.square * ratio));
    }
  }
}

}  // namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE
