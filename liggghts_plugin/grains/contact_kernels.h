#pragma once

#include "grains/contact_pass.h"
#include "suffuse/simd/declare.h"

namespace suffuse::grains {

/// One entry point for each instruction set, defined by compiling contact_kernels.cpp for it: see
/// `contact_pass`. These files are compiled for wide instruction sets, so nothing they call may be an inline
/// function that others share.
#define SUFFUSE_DECLARE_CONTACTS(instruction_set)                                                  \
  namespace instruction_set {                                                                      \
  std::size_t contact_pass(const CandidatePairs& candidates, const GrainArrays& grains,            \
                           const PassSettings& settings, Quad* springs, const PassOutput& output); \
  }
SUFFUSE_FOR_EACH_INSTRUCTION_SET(SUFFUSE_DECLARE_CONTACTS)
#undef SUFFUSE_DECLARE_CONTACTS

}  // namespace suffuse::grains
