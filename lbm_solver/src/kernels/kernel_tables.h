#pragma once

#include "kernel_call.h"
#include "suffuse/lbm/collision_operators.h"
#include "suffuse/simd/declare.h"

namespace suffuse::lbm {

// For each instruction set: the kernels of every law, a table of kKernelVariants (kernels.cpp, compiled for
// each law and storage type), and the bare update.
#define SUFFUSE_DECLARE_LAW(word, law, ...) \
  void fill_##law(Kernel<double>* table);   \
  void fill_##law(Kernel<float>* table);
#define SUFFUSE_DECLARE_KERNELS(instruction_set)   \
  namespace instruction_set {                      \
  SUFFUSE_COLLISION_OPERATORS(SUFFUSE_DECLARE_LAW) \
  void bare_update(const KernelCall<double>&);     \
  void bare_update(const KernelCall<float>&);      \
  }
SUFFUSE_FOR_EACH_INSTRUCTION_SET(SUFFUSE_DECLARE_KERNELS)
#undef SUFFUSE_DECLARE_KERNELS
#undef SUFFUSE_DECLARE_LAW

}  // namespace suffuse::lbm
