#pragma once

#include "collide_central_moments.h"
#include "collide_two_rates.h"
#include "solid_policies.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// Where a cell's populations lie in the two kinds of step of the AA pattern (docs key: bailey2009).
///
/// Even step: direction i is read from the cell's own slot i and, after the collision, written to its own
/// slot of the opposite direction. Odd step: it is read from the neighbour it came from and written to the
/// neighbour it goes to. Either way the 19 places that a cell reads are the 19 that it writes, and no other
/// cell touches them.
template <bool kOdd>
struct Places {
  std::ptrdiff_t offset[kDirections];

  template <class T>
  explicit Places(const KernelCall<T>& call) {
    for (int i = 0; i < kDirections; ++i)
      offset[i] = kVelocity[i][0] + call.row_pitch * kVelocity[i][1] + call.plane_pitch * kVelocity[i][2];
  }
  template <class T>
  [[gnu::always_inline]] T* source(const KernelCall<T>& call, int i, std::ptrdiff_t cell) const {
    return kOdd ? call.slot[opposite(i)] + (cell - offset[i]) : call.slot[i] + cell;
  }
  template <class T>
  [[gnu::always_inline]] T* target(const KernelCall<T>& call, int i, std::ptrdiff_t cell) const {
    return kOdd ? call.slot[i] + (cell + offset[i]) : call.slot[opposite(i)] + cell;
  }
};

/// Density's deviation and momentum of the populations as they stand.
template <class T>
[[gnu::always_inline]] inline void add_up(const Pack<T> (&g)[kDirections], Pack<T>& density_deviation,
                                          Pack<T> (&momentum)[3]) {
  density_deviation = g[0];
  for (int a = 0; a < 3; ++a) momentum[a] = Pack<T>{};
#pragma GCC unroll 19
  for (int i = 1; i < kDirections; i += 2) {
    const Pack<T> difference = g[i] - g[i + 1];
    density_deviation = density_deviation + (g[i] + g[i + 1]);
#pragma GCC unroll 3
    for (int a = 0; a < 3; ++a) {
      if (kVelocity[i][a] == 1) momentum[a] = momentum[a] + difference;
      if (kVelocity[i][a] == -1) momentum[a] = momentum[a] - difference;
    }
  }
}

/// Collides one pack of cells, `lanes` of which lie in the row. g: populations less weights, changed in
/// place.
template <class Operator, class Solid, bool kForced, bool kIncompressible, class T>
[[gnu::always_inline]] inline void collide_pack(Pack<T> (&g)[kDirections], std::ptrdiff_t cells, int lanes,
                                                const KernelCall<T>& call) {
  CellPack<T> cell;
  Pack<T> momentum[3], deviation;
  add_up<T>(g, deviation, momentum);
  if constexpr (kForced)
    for (int a = 0; a < 3; ++a) cell.force[a] = broadcast<T>(call.force[a]);
  if constexpr (Solid::kAddsForce) Solid::force(cells, lanes, call, deviation, momentum, cell.force);
  if constexpr (kForced)
    for (int a = 0; a < 3; ++a) momentum[a] = momentum[a] + T(0.5) * cell.force[a];

  Pack<T> before[kDirections];
  if constexpr (Solid::kMixes)
    for (int i = 0; i < kDirections; ++i) before[i] = g[i];
  if constexpr (kIncompressible) {
    // He & Luo: w_i (rho - 1) is carried through unchanged and the rest collides at density one.
    for (int i = 0; i < kDirections; ++i) g[i] = g[i] - static_cast<T>(kWeight[i]) * deviation;
    cell.density_deviation = Pack<T>{};
    cell.density = broadcast<T>(T(1));
    for (int a = 0; a < 3; ++a) cell.velocity[a] = momentum[a];
  } else {
    cell.density_deviation = deviation;
    cell.density = deviation + T(1);
    const Pack<T> inverse = T(1) / cell.density;
    for (int a = 0; a < 3; ++a) cell.velocity[a] = momentum[a] * inverse;
  }
  Operator::template collide<T>(g, cell, call);
  if constexpr (kIncompressible)
    for (int i = 0; i < kDirections; ++i) g[i] = g[i] + static_cast<T>(kWeight[i]) * deviation;
  if constexpr (Solid::kMixes) Solid::mix(cells, lanes, call, before, g);
}

/// One fused, in-place step over the rows of the call. Knows nothing of boundaries: what enters through a
/// face or from a solid has been put in its place before an odd step and is taken from there after it.
template <class T, class Operator, class Solid, bool kForced, bool kIncompressible, bool kOdd>
void stream_collide(const KernelCall<T>& call) {
  constexpr int width = kPackWidth<T>;
  const Places<kOdd> places(call);
  for (int z = call.begin_z; z < call.end_z; ++z)
    for (int y = call.begin_y; y < call.end_y; ++y) {
      const std::ptrdiff_t row = call.row_pitch * y + call.plane_pitch * z;
      for (int x = 0; x < call.cells_x; x += width) {
        const std::ptrdiff_t cell = row + x;
        const int left = call.cells_x - x, lanes = left < width ? left : width;
        Pack<T> g[kDirections];
#pragma GCC unroll 19
        for (int i = 0; i < kDirections; ++i) g[i] = load<T>(places.source(call, i, cell));
        collide_pack<Operator, Solid, kForced, kIncompressible, T>(g, cell, lanes, call);
        if (lanes == width) {
#pragma GCC unroll 19
          for (int i = 0; i < kDirections; ++i) store<T>(places.target(call, i, cell), g[i]);
        } else {
          for (int i = 0; i < kDirections; ++i) store_first<T>(places.target(call, i, cell), g[i], lanes);
        }
      }
    }
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
