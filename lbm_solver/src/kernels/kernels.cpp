// Compiled once for each instruction set, storage type and law of collision (see CMakeLists.txt), so that the
// program carries them all and chooses at start.
#include SUFFUSE_COLLISION_HEADER

#include "stream_collide.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

namespace {

using Storage = SUFFUSE_KERNEL_STORAGE;

template <int kIndex>
void run_variant(const KernelCall<Storage>& call) {
  constexpr KernelVariant v = variant_of(kIndex);
  using Operator = SUFFUSE_COLLISION_LAW::Law<v.forced, v.eddy_viscosity>;
  using ForcedOperator = SUFFUSE_COLLISION_LAW::Law<true, v.eddy_viscosity>;
  if constexpr (v.solids == SolidKind::none)
    stream_collide<Storage, Operator, NoSolid, v.forced>(call);
  else if constexpr (v.solids == SolidKind::mask)
    stream_collide<Storage, Operator, SolidMask, v.forced>(call);
  else if constexpr (v.solids == SolidKind::mixed)
    stream_collide<Storage, Operator, PartialMixed<v.forced>, v.forced>(call);
  else
    stream_collide<Storage, ForcedOperator, SolidLaw<drag_of(v.solids)>, true>(call);  // a drag is a force
}

template <int kIndex>
void fill(Kernel<Storage>* table) {
  if constexpr (kIndex < kKernelVariants) {
    table[kIndex] = &run_variant<kIndex>;
    fill<kIndex + 1>(table);
  }
}

}  // namespace

#define SUFFUSE_FILL_NAMED(law) fill_##law
#define SUFFUSE_FILL(law) SUFFUSE_FILL_NAMED(law)
void SUFFUSE_FILL(SUFFUSE_COLLISION_LAW)(Kernel<Storage>* table) {
  fill<0>(table);
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
