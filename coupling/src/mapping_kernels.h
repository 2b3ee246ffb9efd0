#pragma once

#include "suffuse/coupling/mapped_sphere.h"

namespace suffuse::coupling {

/// How fractions are written.
struct FractionRule {
  FractionMethod method = FractionMethod::exact;
  int subcells = 5;
  bool own_coefficients = false;  ///< strengths are fractions times the sphere's coefficient
};

/// lbm::HeldTerms.
struct HeldRule {
  double whole, slope;
};

/// The sub-box and its arrays as plain data (see PartialSolidArrays): these files are compiled for wide
/// instruction sets, so that nothing they call may be an inline function that others share.
struct CellArrays {
  int lo[3], cells_x;
  std::ptrdiff_t row_pitch, plane_pitch;
  float *fraction, *strength, *momentum[3];
  const double* exchange_double[3];  ///< one of the two is null
  const float* exchange_float[3];
};

/// One set of entry points for each instruction set, defined by compiling mapping_kernels.cpp for it.
///
/// map_sphere adds a sphere to the cells of those of its planes for which `planes[z]` is not 0, and stores
/// the strengths in its entries.
/// sum_load adds up the exchange of a sphere's cells, and by how much the fluid in them leads.
#define SUFFUSE_DECLARE_MAPPING(instruction_set)                                            \
  namespace instruction_set {                                                               \
  void map_sphere(const MappedSphere& mapped, const FractionRule& rule, const char* planes, \
                  const CellArrays& arrays, float* entries);                                \
  void sum_load(const MappedSphere& mapped, const HeldRule& held, const CellArrays& arrays, \
                const float* entries, LatticeLoad& load);                                   \
  }
SUFFUSE_DECLARE_MAPPING(portable)
SUFFUSE_DECLARE_MAPPING(avx2)
SUFFUSE_DECLARE_MAPPING(avx512)
#undef SUFFUSE_DECLARE_MAPPING

}  // namespace suffuse::coupling
