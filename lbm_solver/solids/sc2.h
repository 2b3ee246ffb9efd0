#pragma once

#include "solid_cells.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// e_i(us) - f_i + (1-rate)(f_i - e_i(u)): relaxation towards the solid's equilibrium (docs key:
/// nobletorczynski1998).
template <>
struct SolidLaw<SolidOperator::sc2> {
  template <class T>
  [[gnu::always_inline]] static Halves<T> pair(const SolidPair<T>& p) {
    return {p.weight * p.solid.even - p.half_sum +
                (T(1) - p.call.even_rate) * (p.half_sum - p.weight * p.fluid.even),
            p.weight * p.solid.odd - p.half_difference +
                (T(1) - p.call.odd_rate) * (p.half_difference - p.weight * p.fluid.odd)};
  }

  template <class T>
  [[gnu::always_inline]] static Pack<T> rest(const SolidRest<T>& r) {
    return r.solid - r.population + (T(1) - r.call.even_rate) * (r.population - r.fluid);
  }
};

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
