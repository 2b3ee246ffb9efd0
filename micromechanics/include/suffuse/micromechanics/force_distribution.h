#pragma once

#include <vector>

#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::micromechanics {

/// Equal bins of the normalised force, from 0 to width × count.
struct ForceBins {
  double width = 0.1;  ///< > 0, dimensionless
  int count = 80;      ///< > 0
};

/// Probability density of contact forces over their own mean (`radjai1996`).
struct ForceDistribution {
  double mean_normal = 0;               ///< ⟨f_N⟩, N; tension negative
  double mean_tangential = 0;           ///< ⟨f_T⟩, N
  std::vector<double> normal;           ///< P(f_N/⟨f_N⟩) of each bin, dimensionless
  std::vector<double> tangential;       ///< P(f_T/⟨f_T⟩)
  double normal_beyond = 0;             ///< share of contacts beyond the last bin: Σ P width = 1 − beyond
  double tangential_beyond = 0;         ///< the same of f_T
  double tensile_share = 0;             ///< share of contacts in tension, which lie in no bin of f_N
  double tail_exponent = 0;             ///< β of P ~ exp(−β f_N/⟨f_N⟩) for forces above the mean
  double coefficient_of_variation = 0;  ///< standard deviation of f_N over ⟨f_N⟩
};

/// Over the contacts that are `counted`, of a whole packing. β is the likeliest one,
/// 1/(⟨f_N/⟨f_N⟩⟩_strong − 1) over the contacts above the mean (Mueth et al. find 1.5; `mueth1998`). All 0
/// without contacts or without forces; tangential 0 where there is none.
ForceDistribution force_distribution(const Packing& packing, const ForceBins& bins);

}  // namespace suffuse::micromechanics
