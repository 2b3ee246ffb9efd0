#pragma once

#include <span>

#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::micromechanics {

/// One rank's part of Σ k_n l², N·m, over its contacts by branch_share. `normal_stiffness`: k_n of each entry
/// of Packing::contacts, N/m, same order (for Hertz contacts the tangent one).
double stiffness_length_sum(const Packing& packing, std::span<const double> normal_stiffness);

/// Upper (Voigt) bound of the bulk modulus of the packing, Pa: all branches shorten alike,
/// K = (1/(9V)) Σ k_n l² (`cambou1995`). `sum` over all ranks, `volume` of the sample, m³, > 0. Exact for
/// packings where the isotropic strain is affine, such as cubic arrays.
double voigt_bulk_modulus(double sum, double volume);

}  // namespace suffuse::micromechanics
