#pragma once

#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// What one rank adds: tr Σ l f over the contacts of each class, N·m.
struct LoadShareSums {
  double coarse_coarse = 0;
  double fine_coarse = 0;
  double fine_fine = 0;
};

LoadShareSums load_share_sums(const Packing& packing, SizeSplit split);

/// Share of the mean stress p' that contacts of each class carry; they add up to 1 (`minhcheng2013`;
/// `sufian2021`). All 0 without stress.
struct LoadShares {
  double coarse_coarse = 0;
  double fine_coarse = 0;
  double fine_fine = 0;
};

LoadShares load_shares(const LoadShareSums& sums);

}  // namespace suffuse::micromechanics
