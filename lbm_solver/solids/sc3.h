#pragma once

#include "solid_cells.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// f_o - f_i + e_i(us) - e_o(us): bounce-back in the solid's frame (docs key: owen2011).
template <>
struct SolidLaw<SolidOperator::sc3> {
  template <class T>
  [[gnu::always_inline]] static Halves<T> pair(const SolidPair<T>& p) {
    return {Pack<T>{}, T(2) * (p.weight * p.solid.odd - p.half_difference)};
  }

  template <class T>
  [[gnu::always_inline]] static Pack<T> rest(const SolidRest<T>&) {
    return Pack<T>{};
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
