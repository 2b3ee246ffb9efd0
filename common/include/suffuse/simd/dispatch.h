#pragma once

#include "suffuse/simd/instruction_set.h"

/// The one place that chooses among the compilations of a vector kernel (cmake/SuffuseVectorKernels.cmake):
/// SUFFUSE_CHOOSE(set, void (*)(double*), add) is `add` of the instruction set's namespace, see declare.h.

namespace suffuse::simd {

/// The function of a set that the machine has (see available_instruction_sets).
template <class Function>
Function chosen(InstructionSet set, Function portable, Function avx2, Function avx512) {
  switch (set) {
    case InstructionSet::avx512:
      return avx512;
    case InstructionSet::avx2:
      return avx2;
    case InstructionSet::portable:
      break;
  }
  return portable;
}

}  // namespace suffuse::simd

#ifdef SUFFUSE_HAVE_X86_KERNELS
#define SUFFUSE_CHOOSE(set, Function, name) \
  ::suffuse::simd::chosen<Function>(set, portable::name, avx2::name, avx512::name)
#else
#define SUFFUSE_CHOOSE(set, Function, name) \
  ::suffuse::simd::chosen<Function>(set, portable::name, portable::name, portable::name)
#endif
