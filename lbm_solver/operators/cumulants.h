#pragma once

#include "central_moments.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

/// The fourth cumulants are set to zero, not the fourth central moments to those of a fluid at rest:
///   k_aabb = (k_aa k_bb + 2 k_ab^2)/rho
/// of the second moments after the collision (docs key: geier2015, on 19 velocities, all rates but the
/// viscosity's one). To first order in the stress this keeps fourth moments orthogonal to it, which central
/// moments at their equilibrium are not. A force enters as it does there.
struct FourthOfCumulants {
  template <class T>
  [[gnu::always_inline]] static Pack<T> fourth(const CellPack<T>& cell, const Pack<T>& beyond_a,
                                               const Pack<T>& beyond_b, const Pack<T>& shear) {
    const Pack<T> products = beyond_a * beyond_b + T(2) * (shear * shear);
    return T(1. / 36) * cell.density_deviation +
           (T(1. / 12) * (beyond_a + beyond_b) + (T(0.25) * cell.inverse_density) * products);
  }
};

namespace cumulants {
template <bool kForced, bool kEddy>
using Law = CentralMoments<kForced, kEddy, FourthOfCumulants>;
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
