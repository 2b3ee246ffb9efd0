#pragma once

#include <cstddef>

namespace suffuse::coupling {

/// Cells of a rank as plain data: see mapping_kernels.h for why.
struct PoreCells {
  int lo[3], cells[3];
  std::ptrdiff_t row_pitch, plane_pitch;  ///< of `fraction`
  const float* fraction;
  std::ptrdiff_t near_row, near_plane;  ///< of the two below, which have room for seven cells past each row
  float* nearness;
  float* surface;
};

/// One set of entry points for each instruction set, defined by compiling pore_kernels.cpp for it.
///
/// add_nearness adds to each cell how near the sphere's surface is (1: within `near` radii or inside, 0:
/// beyond `far`), and the surface in the cell.
/// sum_pores adds up volume and surface of the pores in the ball of so many radii about the sphere.
#define SUFFUSE_DECLARE_PORES(instruction_set)                                                         \
  namespace instruction_set {                                                                          \
  void add_nearness(const double* position, double radius, double near, double far, const PoreCells&); \
  void sum_pores(const double* position, double radius, double reach, const PoreCells& cells,          \
                 double* volume, double* surface);                                                     \
  }
SUFFUSE_DECLARE_PORES(portable)
SUFFUSE_DECLARE_PORES(avx2)
SUFFUSE_DECLARE_PORES(avx512)
#undef SUFFUSE_DECLARE_PORES

}  // namespace suffuse::coupling
