#pragma once

#include "kernel_call.h"
#include "suffuse/lbm/instruction_set.h"

namespace suffuse::lbm {

/// The compiled kernel for a variant, storage type and instruction set.
template <class T>
Kernel<T> kernel_for(InstructionSet instruction_set, const KernelVariant& variant);

/// The bare in-place update of 19 arrays for an instruction set.
template <class T>
BareUpdate<T> bare_update_for(InstructionSet instruction_set);

}  // namespace suffuse::lbm
