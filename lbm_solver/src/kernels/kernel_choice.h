#pragma once

#include "kernel_call.h"
#include "suffuse/lbm/collision_operators.h"
#include "suffuse/lbm/instruction_set.h"

namespace suffuse::lbm {

/// The compiled kernel of an operator for a variant, storage type and instruction set. Cheap: a step asks
/// anew.
template <class T>
Kernel<T> kernel_for(InstructionSet instruction_set, CollisionOperator collision_operator,
                     const KernelVariant& variant);

/// The bare in-place update of 19 arrays for an instruction set.
template <class T>
BareUpdate<T> bare_update_for(InstructionSet instruction_set);

}  // namespace suffuse::lbm
