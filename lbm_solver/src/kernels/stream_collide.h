#pragma once

#include "collide_central_moments.h"
#include "collide_two_rates.h"
#include "solid_policies.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// Density's deviation and momentum of the populations as they stand, summed as trees: short chains of
/// additions let the processor work on the next cells meanwhile.
template <class T>
[[gnu::always_inline]] inline void add_up(const Pack<T> (&g)[kDirections], Pack<T>& density_deviation,
                                          Pack<T> (&momentum)[3]) {
  Pack<T> s[kDirections], d[kDirections];
#pragma GCC unroll 9
  for (int i = 1; i < kDirections; i += 2) {
    s[i] = g[i] + g[i + 1];
    d[i] = g[i] - g[i + 1];
  }
  density_deviation = ((s[1] + s[3]) + (s[5] + s[7])) + ((s[9] + s[11]) + (s[13] + s[15])) + (s[17] + g[0]);
  momentum[0] = d[1] + ((d[7] + d[9]) + (d[11] + d[13]));
  momentum[1] = d[3] + ((d[7] - d[9]) + (d[15] + d[17]));
  momentum[2] = d[5] + ((d[11] - d[13]) + (d[15] - d[17]));
}

/// Collides one pack of cells, `lanes` of which lie in the row. g: populations less weights, changed in
/// place.
template <class Operator, class Solid, bool kForced, class T>
[[gnu::always_inline]] inline void collide_pack(Pack<T> (&g)[kDirections], std::ptrdiff_t cells, int lanes,
                                                const KernelCall<T>& call) {
  CellPack<T> cell;
  Pack<T> momentum[3];
  add_up<T>(g, cell.density_deviation, momentum);
  if constexpr (kForced)
    for (int a = 0; a < 3; ++a) cell.force[a] = broadcast<T>(call.force[a]);
  cell.density = T(1) + call.compressibility * cell.density_deviation;
  if constexpr (Solid::kAddsForce) Solid::force(cells, lanes, call, cell.density, momentum, cell.force);
  if constexpr (kForced)
    for (int a = 0; a < 3; ++a) momentum[a] = momentum[a] + T(0.5) * cell.force[a];
  const Pack<T> inverse = T(1) / cell.density;
  for (int a = 0; a < 3; ++a) cell.velocity[a] = momentum[a] * inverse;

  Pack<T> before[kDirections];
  if constexpr (Solid::kMixes)
    for (int i = 0; i < kDirections; ++i) before[i] = g[i];
  Operator::template collide<T>(g, cell, call);
  if constexpr (Solid::kMixes) Solid::mix(cells, lanes, call, cell, before, g);
}

/// How far ahead of a load its stream is fetched. Nineteen streams are more than the hardware prefetcher of
/// the machines at hand follows: without this a step reaches 0.75 of the bare update in double and 0.65 in
/// float, with 256 or 512 bytes 0.93 and 0.87 (docs/performance.md). Fetching past the end of a row is the
/// next row; past the array, harmless.
inline constexpr int kPrefetchBytes = 512;

/// Steps `packs` packs of neighbouring cells. The last part of a row, shorter than a pack, comes here as well
/// (see below), so that every cell goes through these very instructions and results do not depend on how rows
/// are cut.
template <class T, class Operator, class Solid, bool kForced>
[[gnu::noinline]] void step_packs(T* const (&place)[kDirections], std::ptrdiff_t first_cell,
                                  std::ptrdiff_t packs, int lanes, const KernelCall<T>& shared) {
  constexpr int width = kPackWidth<T>;
  const KernelCall<T> call = shared;  // a copy of our own: stores through T* cannot change it
  T* p[kDirections];
#pragma GCC unroll 19
  for (int i = 0; i < kDirections; ++i) p[i] = place[i];
  for (std::ptrdiff_t x = 0; x < packs * width; x += width) {
    Pack<T> g[kDirections];
#pragma GCC unroll 19
    for (int i = 0; i < kDirections; ++i) {
      g[i] = load<T>(p[i] + x);
      __builtin_prefetch(reinterpret_cast<const char*>(p[i] + x) + kPrefetchBytes, 1);
    }
    collide_pack<Operator, Solid, kForced, T>(g, first_cell + x, lanes, call);
#pragma GCC unroll 19
    for (int i = 0; i < kDirections; ++i) store<T>(p[opposite(i)] + x, g[i]);
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
  constexpr int width = kPackWidth<T>;
  const std::ptrdiff_t packs = call.cells_x / width;
  const int rest = static_cast<int>(call.cells_x - packs * width);
  for (int z = call.begin_z; z < call.end_z; ++z)
    for (int y = call.begin_y; y < call.end_y; ++y) {
      const std::ptrdiff_t row = call.row_pitch * y + call.plane_pitch * z;
      T* place[kDirections];
      for (int i = 0; i < kDirections; ++i) place[i] = call.place[i] + row;
      step_packs<T, Operator, Solid, kForced>(place, row, packs, width, call);
      if (rest == 0) continue;
      Pack<T> scratch[kDirections] = {};
      T* copy[kDirections];
      for (int i = 0; i < kDirections; ++i) {
        copy[i] = reinterpret_cast<T*>(&scratch[i]);
        for (int lane = 0; lane < rest; ++lane) copy[i][lane] = place[i][packs * width + lane];
      }
      step_packs<T, Operator, Solid, kForced>(copy, row + packs * width, 1, rest, call);
      for (int i = 0; i < kDirections; ++i)
        for (int lane = 0; lane < rest; ++lane) place[i][packs * width + lane] = copy[i][lane];
    }
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
