#include "grains/contact_pass.h"

#include "grains/contact_kernels.h"
#include "suffuse/simd/dispatch.h"

namespace suffuse::grains {

std::size_t contact_pass(InstructionSet instruction_set, const CandidatePairs& candidates,
                         const GrainArrays& grains, const PassSettings& settings, Quad* springs,
                         const PassOutput& output) {
  const auto pass = SUFFUSE_CHOOSE(instruction_set, decltype(&portable::contact_pass), contact_pass);
  return pass(candidates, grains, settings, springs, output);
}

}  // namespace suffuse::grains
