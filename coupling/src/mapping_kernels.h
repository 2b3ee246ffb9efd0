#pragma once

#include <cstddef>

#include "suffuse/coupling/mapped_sphere.h"
#include "suffuse/simd/declare.h"

namespace suffuse::coupling {

/// Spheres with a smaller radius (cells) are mapped by the exact rule where the linear one is asked for.
inline constexpr float kLeastLinearRadius = 1;

/// How fractions are written.
struct FractionRule {
  FractionMethod method = FractionMethod::exact;
  int subcells = 5;
  bool own_coefficients = false;  ///< strengths are fractions times the coefficients of sphere and pore
};

/// lbm::HeldTerms
struct HeldRule {
  float base, slope, least;
};

/// The sub-box and its arrays as plain data (see PartialSolidArrays): these files are compiled for wide
/// instruction sets, so that nothing they call may be an inline function that others share.
struct CellArrays {
  int lo[3], cells_x;
  std::ptrdiff_t row_pitch, plane_pitch;
  float *fraction, *strength, *momentum[3];
  const float* pore_coefficient;     ///< null: none
  const double* exchange_double[3];  ///< one of the two is null
  const float* exchange_float[3];
};

/// The slices of spheres in one block of rows: rows begin_y <= y < end_y of plane z of the sub-box, and which
/// of `spheres` may reach them.
struct SliceList {
  int z, begin_y, end_y;
  const MappedSphere* spheres;
  const int* numbers;
  int count;
};

/// What is kept of the slices of one block until their loads are summed.
struct SliceNotes {
  SliceRows* rows;  ///< one a slice
  float* entries;   ///< the slices' own strengths, eight for each row of each pack of a slice
};

/// One set of entry points for each instruction set, defined by compiling mapping_kernels.cpp for it.
///
/// map_slices adds the slices to the cells, one after the other.
/// strengths_of leaves the cells alone; both write the slices' notes.
/// sum_loads adds the exchange of the slices' cells to the spheres' `loads`, from these notes, and to
/// `internal_fluid_momentum` and `internal_fluid_spin` what the rule makes of it.
#define SUFFUSE_DECLARE_MAPPING(instruction_set)                                               \
  namespace instruction_set {                                                                  \
  void map_slices(const SliceList& list, const FractionRule& rule, const CellArrays& arrays,   \
                  const SliceNotes& notes);                                                    \
  void strengths_of(const SliceList& list, const FractionRule& rule, const CellArrays& arrays, \
                    const SliceNotes& notes);                                                  \
  void sum_loads(const SliceList& list, const CellArrays& arrays, const HeldRule& held,        \
                 const SliceNotes& notes, LatticeLoad* loads);                                 \
  }
SUFFUSE_FOR_EACH_INSTRUCTION_SET(SUFFUSE_DECLARE_MAPPING)
#undef SUFFUSE_DECLARE_MAPPING

}  // namespace suffuse::coupling
