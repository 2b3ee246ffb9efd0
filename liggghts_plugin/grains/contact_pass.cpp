#include "grains/contact_pass.h"

#include "grains/contact_kernels.h"

namespace suffuse::grains {

std::size_t contact_pass(InstructionSet instruction_set, const CandidatePairs& candidates,
                         const GrainArrays& grains, const PassSettings& settings, Quad* springs,
                         const PassOutput& output) {
  switch (instruction_set) {
#ifdef SUFFUSE_HAVE_X86_KERNELS
    case InstructionSet::avx512:
      return avx512::contact_pass(candidates, grains, settings, springs, output);
    case InstructionSet::avx2:
      return avx2::contact_pass(candidates, grains, settings, springs, output);
#endif
    default:
      return portable::contact_pass(candidates, grains, settings, springs, output);
  }
}

}  // namespace suffuse::grains
