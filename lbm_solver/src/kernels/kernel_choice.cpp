#include "kernel_choice.h"

#include "kernel_tables.h"
#include "suffuse/simd/dispatch.h"

namespace suffuse::lbm {

template <class T>
Kernel<T> kernel_for(InstructionSet instruction_set, CollisionOperator collision_operator,
                     const KernelVariant& variant) {
  using Fill = void (*)(Kernel<T>*);
  Fill fill = nullptr;
  switch (collision_operator) {
#define SUFFUSE_TABLE(word, law, ...)                         \
  case CollisionOperator::word:                               \
    fill = SUFFUSE_CHOOSE(instruction_set, Fill, fill_##law); \
    break;
    SUFFUSE_COLLISION_OPERATORS(SUFFUSE_TABLE)
#undef SUFFUSE_TABLE
  }
  Kernel<T> table[kKernelVariants];
  fill(table);
  return table[index_of(variant)];
}

template <class T>
BareUpdate<T> bare_update_for(InstructionSet instruction_set) {
  return SUFFUSE_CHOOSE(instruction_set, BareUpdate<T>, bare_update);
}

template Kernel<double> kernel_for<double>(InstructionSet, CollisionOperator, const KernelVariant&);
template Kernel<float> kernel_for<float>(InstructionSet, CollisionOperator, const KernelVariant&);
template BareUpdate<double> bare_update_for<double>(InstructionSet);
template BareUpdate<float> bare_update_for<float>(InstructionSet);

}  // namespace suffuse::lbm
