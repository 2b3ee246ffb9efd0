#pragma once

/// The D3Q19 lattice: velocities, weights and index rules (thesis eqs 3.25-3.27, 3.31).
///
/// Everything here is constexpr plain data, because the vectorised kernels are compiled for several
/// instruction sets and must not share compiled functions with the rest of the program.

namespace suffuse::lbm {

inline constexpr int kDirections = 19;

/// Velocity of each direction, cells per step. Direction 0 rests; 2k-1 and 2k are opposite.
inline constexpr int kVelocity[kDirections][3] = {{0, 0, 0},                                       //
                                                  {1, 0, 0}, {-1, 0, 0},  {0, 1, 0},  {0, -1, 0},  //
                                                  {0, 0, 1}, {0, 0, -1},                           //
                                                  {1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0},  //
                                                  {1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {-1, 0, 1},  //
                                                  {0, 1, 1}, {0, -1, -1}, {0, 1, -1}, {0, -1, 1}};

/// Weights: 1/3 at rest, 1/18 along an axis, 1/36 along a face diagonal.
inline constexpr double kWeight[kDirections] = {1. / 3,  1. / 18, 1. / 18, 1. / 18, 1. / 18, 1. / 18, 1. / 18,
                                                1. / 36, 1. / 36, 1. / 36, 1. / 36, 1. / 36, 1. / 36, 1. / 36,
                                                1. / 36, 1. / 36, 1. / 36, 1. / 36, 1. / 36};

/// Square of the lattice speed of sound (thesis eq 3.31): pressure = density / 3 in lattice units.
inline constexpr double kSoundSpeedSquared = 1. / 3;

/// The direction that points the other way.
constexpr int opposite(int direction) {
  return direction == 0 ? 0 : ((direction - 1) ^ 1) + 1;
}

/// The direction with the given velocity, or -1 where D3Q19 has none (the cube's corners).
constexpr int direction_of(int cx, int cy, int cz) {
  for (int i = 0; i < kDirections; ++i)
    if (kVelocity[i][0] == cx && kVelocity[i][1] == cy && kVelocity[i][2] == cz) return i;
  return -1;
}

/// The mirror image of a direction in a plane normal to `axis` (0, 1 or 2).
constexpr int reflected(int direction, int axis) {
  const int* c = kVelocity[direction];
  return direction_of(axis == 0 ? -c[0] : c[0], axis == 1 ? -c[1] : c[1], axis == 2 ? -c[2] : c[2]);
}

}  // namespace suffuse::lbm
