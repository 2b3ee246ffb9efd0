#pragma once

#include "solid_cells.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// f_o - f_i + e_i(us) - e_o(u): bounce-back of the non-equilibrium part (docs key: nobletorczynski1998).
template <>
struct SolidLaw<SolidOperator::sc1> {
  template <class T>
  [[gnu::always_inline]] static Halves<T> pair(const SolidPair<T>& p) {
    return {p.weight * (p.solid.even - p.fluid.even),
            p.weight * (p.solid.odd + p.fluid.odd) - T(2) * p.half_difference};
  }

  template <class T>
  [[gnu::always_inline]] static Pack<T> rest(const SolidRest<T>& r) {
    return r.solid - r.fluid;
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
