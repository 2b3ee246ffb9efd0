#pragma once

#include "solid_policies.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// Density's deviation and momentum of the populations as they stand, summed as trees: short chains of
/// additions let the processor work on the next cells meanwhile.
template <class T, class Populations>
[[gnu::always_inline]] inline void add_up(const Populations& g, Pack<T>& density_deviation,
                                          Pack<T> (&momentum)[3]) {
  Pack<T> s[kDirections], d[kDirections];
#pragma GCC unroll 9
  for (int i = 1; i < kDirections; i += 2) {
    const Pack<T> forward = g.get(i), backward = g.get(i + 1);
    s[i] = forward + backward;
    d[i] = forward - backward;
  }
  // The sums of planes are what the operators need again.
  density_deviation =
      (((s[1] + s[3]) + s[5]) + g.get(0)) + (((s[7] + s[9]) + (s[11] + s[13])) + (s[15] + s[17]));
  momentum[0] = d[1] + ((d[7] + d[9]) + (d[11] + d[13]));
  momentum[1] = d[3] + ((d[7] - d[9]) + (d[15] + d[17]));
  momentum[2] = d[5] + ((d[11] - d[13]) + (d[15] - d[17]));
}

/// Collides one pack of cells, `lanes` of which lie in the row. g: populations less weights, changed in
/// place. Operator::kKeepsSums: it needs most of the sums of add_up again, which then stay in registers; for
/// the others reading the populations twice is cheaper.
template <class Operator, class Solid, bool kForced, class T, class Populations>
[[gnu::always_inline]] inline void collide_pack(Populations& g, std::ptrdiff_t cells, int lanes,
                                                const KernelCall<T>& call) {
  CellPack<T> cell;
  add_up<T>(g, cell.density_deviation, cell.momentum);
  if constexpr (!Operator::kKeepsSums)
    asm volatile("" ::: "memory");  // what comes from memory is read again, not kept on the stack
  if constexpr (kForced)
    for (int a = 0; a < 3; ++a) cell.force[a] = broadcast<T>(call.force[a]);
  cell.density = T(1) + call.compressibility * cell.density_deviation;
  if constexpr (kForced)
    for (int a = 0; a < 3; ++a) cell.momentum[a] = cell.momentum[a] + T(0.5) * cell.force[a];
  cell.inverse_density = T(1) / cell.density;
  if constexpr (Solid::kAddsForce) Solid::force(cells, lanes, call, cell);
  for (int a = 0; a < 3; ++a) cell.velocity[a] = cell.momentum[a] * cell.inverse_density;

  if constexpr (Solid::kMixes) {
    const Populations before = g;
    Operator::template collide<T>(g, cell, call);
    Solid::mix(cells, lanes, call, cell, before.values, g.values);
  } else {
    Operator::template collide<T>(g, cell, call);
  }
}

/// How far ahead of a load its stream is fetched. Nineteen streams are more than the hardware prefetcher of
/// the machines at hand follows: without this a step reaches 0.75 of the bare update in double and 0.65 in
/// float, with 256 or 512 bytes 0.93 and 0.87 (docs/performance.md). Fetching past the end of a row is the
/// next row; past the array, harmless.
inline constexpr int kPrefetchBytes = 512;
inline constexpr int kLineBytes = 64;  ///< each cache line is fetched once

/// Steps one row. Its last pack may reach beyond it: those lanes are collided as well, and then keep what
/// they held. So every cell goes through these very instructions, and results do not depend on how rows are
/// cut.
template <class T, class Operator, class Solid, bool kForced>
[[gnu::noinline]] void step_row(T* const (&place)[kDirections], std::ptrdiff_t row,
                                const KernelCall<T>& shared) {
  constexpr int width = kPackWidth<T>;
  const KernelCall<T> call = shared;  // a copy of our own: stores through T* cannot change it
  T* p[kDirections];
#pragma GCC unroll 19
  for (int i = 0; i < kDirections; ++i) p[i] = place[i];
  for (std::ptrdiff_t x = 0; x < call.cells_x; x += width) {
    const int lanes = call.cells_x - x < width ? static_cast<int>(call.cells_x - x) : width;
    if (kPackBytes == kLineBytes || x % (kLineBytes / static_cast<int>(sizeof(T))) == 0) {
#pragma GCC unroll 19
      for (int i = 0; i < kDirections; ++i)
        __builtin_prefetch(reinterpret_cast<const char*>(p[i] + x) + kPrefetchBytes, 1);
    }
    if constexpr (!Solid::kMixes) {
      PlacedPopulations<T> g{p, x, lanes};
      collide_pack<Operator, Solid, kForced, T>(g, row + x, lanes, call);
    } else {
      HeldPopulations<T> g;
#pragma GCC unroll 19
      for (int i = 0; i < kDirections; ++i) g.values[i] = load<T>(p[i] + x);
      collide_pack<Operator, Solid, kForced, T>(g, row + x, lanes, call);
#pragma GCC unroll 19
      for (int i = 0; i < kDirections; ++i) {
        if (lanes == width)
          store<T>(p[opposite(i)] + x, g.values[i]);
        else
          store_lanes<T>(p[opposite(i)] + x, g.values[i], lanes);
      }
    }
  }
}

/// One fused, in-place step of the AA pattern (docs key: bailey2009) over the rows of the call.
///
/// A cell reads direction i at place[i] and writes it, collided, to place[opposite(i)]; which memory these
/// places are differs between even and odd steps and is the caller's business. The 19 places that a cell
/// reads are the 19 that it writes, and no other cell touches them. Nothing here knows of boundaries: what
/// enters through a face or from a solid lies in its place before the sweep.
template <class T, class Operator, class Solid, bool kForced>
void stream_collide(const KernelCall<T>& call) {
  for (int z = call.begin_z; z < call.end_z; ++z)
    for (int y = call.begin_y; y < call.end_y; ++y) {
      const std::ptrdiff_t row = call.row_pitch * y + call.plane_pitch * z;
      T* place[kDirections];
      for (int i = 0; i < kDirections; ++i) place[i] = call.place[i] + row;
      step_row<T, Operator, Solid, kForced>(place, row, call);
    }
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
