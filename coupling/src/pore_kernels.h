#pragma once

#include <cstddef>

#include "suffuse/simd/declare.h"

namespace suffuse::coupling {

/// Cells of a rank as plain data (see mapping_kernels.h for why), with the layout of the fractions.
struct PoreCells {
  int lo[3], cells[3];
  std::ptrdiff_t row_pitch, plane_pitch;
  float* surface;  ///< smoothed: area of grains in a volume over that volume, 1/cells
  float* solid;    ///< smoothed: volume of grains in it over that volume
  float* range;    ///< of the window in a cell, at most each sphere's radius, cells; null: that radius
};

/// What CoefficientLaw makes of the surface per volume of pore, S/V: linear S/V + square (S/V)^2 +
/// fourth (S/V)^4.
struct PoreTerms {
  float linear, square, fourth, open;  ///< `open` is added to V
};

/// One set of entry points for each instruction set, defined by compiling pore_kernels.cpp for it.
///
/// add_radius adds, through the window of a sphere's own radius, its surface and (in `solid`) that times the
/// radius to the cells within twice the radius. range_plane makes of both `reach` times the mean radius of
/// the surfaces that a cell sees, at least `shortest` cells.
/// add_smoothed adds a sphere's surface and volume to the cells that see it.
/// narrow_plane writes what the terms give over the surface.
#define SUFFUSE_DECLARE_PORES(instruction_set)                                      \
  namespace instruction_set {                                                       \
  void add_radius(const double* position, double radius, const PoreCells& cells);   \
  void range_plane(const PoreCells& cells, float reach, float shortest, int z);     \
  void add_smoothed(const double* position, double radius, const PoreCells& cells); \
  void narrow_plane(const PoreCells& cells, const PoreTerms& terms, int z);         \
  }
SUFFUSE_FOR_EACH_INSTRUCTION_SET(SUFFUSE_DECLARE_PORES)
#undef SUFFUSE_DECLARE_PORES

}  // namespace suffuse::coupling
