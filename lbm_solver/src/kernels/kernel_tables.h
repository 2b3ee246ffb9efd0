#pragma once

#include "kernel_call.h"

namespace suffuse::lbm {

// One set of entry points for each instruction set, defined by compiling kernels.cpp for it.
#define SUFFUSE_DECLARE_KERNELS(instruction_set) \
  namespace instruction_set {                    \
  void fill_two_rates(Kernel<double>* table);    \
  void fill_two_rates(Kernel<float>* table);     \
  void fill_central_moments(Kernel<double>*);    \
  void fill_central_moments(Kernel<float>*);     \
  void fill_comoving_rates(Kernel<double>*);     \
  void fill_comoving_rates(Kernel<float>*);      \
  void bare_update(const KernelCall<double>&);   \
  void bare_update(const KernelCall<float>&);    \
  }
SUFFUSE_DECLARE_KERNELS(portable)
SUFFUSE_DECLARE_KERNELS(avx2)
SUFFUSE_DECLARE_KERNELS(avx512)
#undef SUFFUSE_DECLARE_KERNELS

}  // namespace suffuse::lbm
