#pragma once

// Shared by the fluid's tests: boxes of faces, random states that do not depend on the decomposition.

#include <mpi.h>

#include <cstdint>

#include "suffuse/lbm/fluid.h"
#include "suffuse/lbm/lattice.h"

namespace suffuse::lbm::test {

inline FaceConditions same_everywhere(FaceKind kind) {
  FaceConditions faces;
  for (FaceCondition& face : faces) face.kind = kind;
  return faces;
}

/// Faces by axis: kinds of x, y and z, the same at both ends.
inline FaceConditions by_axis(FaceKind x, FaceKind y, FaceKind z) {
  FaceConditions faces;
  const FaceKind kinds[] = {x, y, z};
  for (std::size_t f = 0; f < kFaces; ++f) faces[f].kind = kinds[f / 2];
  return faces;
}

/// Uniform in [-1, 1), a pure function of its arguments (splitmix64), so that every rank and every solver
/// agree.
inline double noise(const Index3& cell, int direction, std::uint64_t seed = 1) {
  std::uint64_t h = seed * 0x9e3779b97f4a7c15ULL;
  for (const int v : {cell[0], cell[1], cell[2], direction}) {
    h += static_cast<std::uint64_t>(v + 1) * 0x9e3779b97f4a7c15ULL;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

/// Deviations of a few per cent of the weights: far from any equilibrium, near enough to stay stable for some
/// steps.
inline double random_population(int direction, const Index3& cell) {
  return 0.05 * kWeight[direction] * noise(cell, direction);
}

template <class AnyFluid>
void set_random_state(AnyFluid& fluid, const CellBox& cells) {
  for_each_cell(cells, [&](int x, int y, int z) {
    for (int i = 0; i < kDirections; ++i) fluid.set_population(i, {x, y, z}, random_population(i, {x, y, z}));
  });
}

}  // namespace suffuse::lbm::test
