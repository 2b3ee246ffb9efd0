#include "kernel_choice.h"

#include <array>

#include "kernel_tables.h"

namespace suffuse::lbm {

namespace {

template <class T>
using Table = std::array<Kernel<T>, kKernelVariants>;

template <class T>
Table<T> table_for(InstructionSet instruction_set) {
  Table<T> table{};
  switch (instruction_set) {
#ifdef SUFFUSE_HAVE_X86_KERNELS
    case InstructionSet::avx512:
      avx512::fill_two_rates(table.data());
      avx512::fill_central_moments(table.data());
      avx512::fill_comoving_rates(table.data());
      break;
    case InstructionSet::avx2:
      avx2::fill_two_rates(table.data());
      avx2::fill_central_moments(table.data());
      avx2::fill_comoving_rates(table.data());
      break;
#endif
    default:
      portable::fill_two_rates(table.data());
      portable::fill_central_moments(table.data());
      portable::fill_comoving_rates(table.data());
  }
  return table;
}

}  // namespace

template <class T>
Kernel<T> kernel_for(InstructionSet instruction_set, const KernelVariant& variant) {
  static const Table<T> portable_table = table_for<T>(InstructionSet::portable);
  static const Table<T> avx2_table = table_for<T>(InstructionSet::avx2);
  static const Table<T> avx512_table = table_for<T>(InstructionSet::avx512);
  const std::size_t index = static_cast<std::size_t>(index_of(variant));
  switch (instruction_set) {
    case InstructionSet::avx512:
      return avx512_table[index];
    case InstructionSet::avx2:
      return avx2_table[index];
    default:
      return portable_table[index];
  }
}

template <class T>
BareUpdate<T> bare_update_for(InstructionSet instruction_set) {
  switch (instruction_set) {
#ifdef SUFFUSE_HAVE_X86_KERNELS
    case InstructionSet::avx512:
      return static_cast<BareUpdate<T>>(&avx512::bare_update);
    case InstructionSet::avx2:
      return static_cast<BareUpdate<T>>(&avx2::bare_update);
#endif
    default:
      return static_cast<BareUpdate<T>>(&portable::bare_update);
  }
}

template Kernel<double> kernel_for<double>(InstructionSet, const KernelVariant&);
template Kernel<float> kernel_for<float>(InstructionSet, const KernelVariant&);
template BareUpdate<double> bare_update_for<double>(InstructionSet);
template BareUpdate<float> bare_update_for<float>(InstructionSet);

}  // namespace suffuse::lbm
