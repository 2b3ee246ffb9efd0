// Compiled once for each instruction set, as mapping_kernels.cpp.
#include "pore_kernels.h"

#include "sphere_fraction.h"

namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE {

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

[[gnu::always_inline]] inline Floats clamped(const Floats& v) {
  return lesser(greater(v, Floats{}), Floats{} + 1.f);
}

}  // namespace

void add_nearness(const double* position, double radius, double near, double far, const PoreCells& cells) {
  const float r = static_cast<float>(radius), slope = static_cast<float>(1 / ((far - near) * radius)),
              start = static_cast<float>(far / (far - near));
  const double reach = radius * (1 + far) > radius + 1 ? radius * (1 + far) : radius + 1;
  for_rows(position, reach, cells, [&](int y, int z, const Range& xs, double rest) {
    const std::ptrdiff_t row = cells.near_row * y + cells.near_plane * z;
    const Floats other = Floats{} + static_cast<float>(rest);
    for (int x = xs.begin; x < xs.end; x += kLanes) {
      const Floats dx = distances(x, cells, position[0]), in = first_lanes(xs.end - x);
      const Floats depth = square_root(dx * dx + other) - r;
      const Floats nearness = (in * clamped(start - slope * depth) + kRounding) - kRounding;
      const Floats surface = (in * greater(1.f - magnitude(depth), Floats{}) + kRounding) - kRounding;
      store(cells.nearness + row + x, load(cells.nearness + row + x) + nearness);
      store(cells.surface + row + x, load(cells.surface + row + x) + surface);
    }
  });
}

void sum_pores(const double* position, double radius, double reach, const PoreCells& cells, double* volume,
               double* surface) {
  const double outer = reach * radius;
  const float scale = static_cast<float>(1 / (outer * outer));
  Doubles volumes{}, surfaces{};
  for_rows(position, outer, cells, [&](int y, int z, const Range& xs, double rest) {
    const std::ptrdiff_t row = cells.near_row * y + cells.near_plane * z;
    const float* fraction = cells.fraction + cells.row_pitch * y + cells.plane_pitch * z;
    const Floats other = Floats{} + static_cast<float>(rest);
    for (int x = xs.begin; x < xs.end; x += kLanes) {
      const Floats dx = distances(x, cells, position[0]);
      const Floats weight = first_lanes(xs.end - x) * greater(1.f - scale * (dx * dx + other), Floats{}) *
                            clamped(load(cells.nearness + row + x) - 1.f);
      const Floats open = greater(1.f - load(fraction + x), Floats{});
      volumes += __builtin_convertvector(weight * open, Doubles);
      surfaces += __builtin_convertvector(weight * load(cells.surface + row + x), Doubles);
    }
  });
  for (int lane = 0; lane < kLanes; ++lane) {
    *volume += volumes[lane];
    *surface += surfaces[lane];
  }
}

}  // namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE
