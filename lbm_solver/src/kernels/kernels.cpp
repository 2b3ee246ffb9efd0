// Compiled once for each instruction set, storage type and family of operators (see CMakeLists.txt), so that
// the program carries them all and chooses at start.
#include "kernel_tables.h"
#include "stream_collide.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

namespace {

using Storage = SUFFUSE_KERNEL_STORAGE;

template <OperatorFamily kFamily, bool kForced, bool kEddy>
struct OperatorOf {
  using Type = TwoRates<kForced, kEddy, kFamily == OperatorFamily::comoving_rates>;
};
template <bool kForced, bool kEddy>
struct OperatorOf<OperatorFamily::central_moments, kForced, kEddy> {
  using Type = CentralMoments<kForced, kEddy>;
};

template <int kIndex>
void run_variant(const KernelCall<Storage>& call) {
  constexpr KernelVariant v = variant_of(kIndex);
  using Operator = typename OperatorOf<v.family, v.forced, v.eddy_viscosity>::Type;
  using ForcedOperator = typename OperatorOf<v.family, true, v.eddy_viscosity>::Type;
  if constexpr (v.solids == SolidKind::mask)
    stream_collide<Storage, Operator, SolidMask, v.forced>(call);
  else if constexpr (v.solids == SolidKind::partial_force)
    stream_collide<Storage, ForcedOperator, PartialForce, true>(call);  // the drag is a force
  else if constexpr (v.solids == SolidKind::partial_mixed)
    stream_collide<Storage, Operator, PartialMixed<v.forced>, v.forced>(call);
  else
    stream_collide<Storage, Operator, NoSolid, v.forced>(call);
}

/// Fills the entries that this file is compiled for.
template <int kIndex>
void fill(Kernel<Storage>* table) {
  if constexpr (kIndex < kKernelVariants) {
    if constexpr (variant_of(kIndex).family == static_cast<OperatorFamily>(SUFFUSE_KERNEL_FAMILY))
      table[kIndex] = &run_variant<kIndex>;
    fill<kIndex + 1>(table);
  }
}

}  // namespace

#if SUFFUSE_KERNEL_FAMILY == 1
void fill_central_moments(Kernel<Storage>* table) {
  fill<0>(table);
}
#elif SUFFUSE_KERNEL_FAMILY == 2
void fill_comoving_rates(Kernel<Storage>* table) {
  fill<0>(table);
}
#else
void fill_two_rates(Kernel<Storage>* table) {
  fill<0>(table);
}

void bare_update(const KernelCall<Storage>& call) {
  constexpr int width = kPackWidth<Storage>;
  for (int z = call.begin_z; z < call.end_z; ++z)
    for (int y = call.begin_y; y < call.end_y; ++y) {
      const std::ptrdiff_t row = call.row_pitch * y + call.plane_pitch * z;
      for (int x = 0; x + width <= call.cells_x; x += width) {
#pragma GCC unroll 19
        for (int i = 0; i < kDirections; ++i) {
          Storage* place = call.place[i] + row + x;
          store<Storage>(place, load<Storage>(place) * call.even_rate + call.force[0]);
        }
      }
    }
}
#endif

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
