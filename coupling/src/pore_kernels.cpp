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

/// A sphere of radius r >= 1 seen through the window w = (15/8 pi) (1 - t^2), t < 1 the distance from the
/// place of interest, whose distance from the sphere's centre is q < 1 + r; lengths in ranges of the window.
/// Integrals over shells of that t: of w over the sphere's surface, and of w over its inside.
struct Smoothed {
  Floats surface, solid;
};
[[gnu::always_inline]] inline Smoothed smoothed(const Floats& distance, const Floats& radius) {
  constexpr float pi = 3.14159265f, scale = 15 / (8 * pi);
  const Floats q = greater(distance, Floats{} + 0.05f), inverse = 1.f / q;
  const Floats l = lesser(magnitude(q - radius), Floats{} + 1.f), l2 = l * l, l4 = l2 * l2;
  // The surface lies in shells from l to 1: 2 pi r/q times the integral of w t.
  const Floats ring = 0.25f - (0.5f * l2 - 0.25f * l4);
  // The part of a shell that is inside is a cap, of 1 - (q^2 + t^2 - r^2)/(2 q t) times a half of it.
  const Floats whole = l * l2 * (1.f / 3) - l * l4 * 0.2f;  // integral of w t^2 up to l
  const Floats caps =
      (2.f / 15 - whole) * (2 * pi) -
      inverse * pi * ((q * q - radius * radius) * ring + (1.f / 12 - (0.25f * l4 - l4 * l2 * (1.f / 6))));
  const Floats core = q < radius ? (4 * pi) * whole : Floats{};
  return {scale * 2 * pi * radius * inverse * ring, scale * (caps + core)};
}

[[gnu::always_inline]] inline Floats rounded(const Floats& value) {
  return (value + kRounding) - kRounding;
}

/// Adds value(a sphere's surface and volume in a cell) to the cells that see the sphere: surface, and what
/// goes into `solid`.
template <class Value>
[[gnu::always_inline]] inline void add_sphere(const double* position, double radius, const PoreCells& cells,
                                              const Value& value) {
  const Floats own = Floats{} + static_cast<float>(radius);
  for_rows(position, 2 * radius, cells, [&](int y, int z, const Range& xs, double rest) {
    const std::ptrdiff_t row = cells.row_pitch * y + cells.plane_pitch * z;
    const Floats other = Floats{} + static_cast<float>(rest);
    for (int x = xs.begin; x < xs.end; x += kLanes) {
      const Floats dx = distances(x, cells, position[0]);
      const Floats range = cells.range ? lesser(own, load(cells.range + row + x)) : own;
      const Floats inverse = 1.f / range, r = own * inverse, farthest = r + 1.f;
      const Floats q = lesser(square_root(dx * dx + other) * inverse, farthest);
      const Floats in = q < farthest ? first_lanes(xs.end - x) : Floats{};
      const Smoothed sphere = smoothed(q, r);
      const Floats surface = rounded(in * sphere.surface * inverse);
      store(cells.surface + row + x, load(cells.surface + row + x) + surface);
      store(cells.solid + row + x, load(cells.solid + row + x) + value(surface, in * sphere.solid));
    }
  });
}

}  // namespace

void add_radius(const double* position, double radius, const PoreCells& cells) {
  const float own = static_cast<float>(radius);
  add_sphere(position, radius, cells,
             [&](const Floats& surface, const Floats&) { return rounded(surface * own); });
}

void range_plane(const PoreCells& cells, float reach, float shortest, int z) {
  constexpr float least = 1.f / 1024;  // less is mostly rounding, and no narrow pore
  for (int y = 0; y < cells.cells[1]; ++y) {
    const std::ptrdiff_t row = cells.row_pitch * y + cells.plane_pitch * z;
    for (int x = 0; x < cells.cells[0]; x += kLanes) {
      const Floats surface = load(cells.surface + row + x);
      const Floats mean = load(cells.solid + row + x) / greater(surface, Floats{} + least);
      const Floats range = greater(reach * mean, Floats{} + shortest);
      store(cells.range + row + x, surface > least ? range : Floats{} + 1e6f);
    }
  }
}

void add_smoothed(const double* position, double radius, const PoreCells& cells) {
  add_sphere(position, radius, cells, [](const Floats&, const Floats& solid) { return rounded(solid); });
}

void narrow_plane(const PoreCells& cells, const PoreTerms& terms, int z) {
  for (int y = 0; y < cells.cells[1]; ++y) {
    const std::ptrdiff_t row = cells.row_pitch * y + cells.plane_pitch * z;
    for (int x = 0; x < cells.cells[0]; x += kLanes) {
      const Floats open = greater(1.f - load(cells.solid + row + x), Floats{}) + terms.open;
      const Floats ratio = load(cells.surface + row + x) / open;
      const Floats higher = terms.square + terms.fourth * (ratio * ratio);
      store(cells.surface + row + x, ratio * (terms.linear + higher * ratio));
    }
  }
}

}  // namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE
