#include "suffuse/micromechanics/load_shares.h"

namespace suffuse::micromechanics {

LoadShareSums load_share_sums(const Packing& packing, SizeSplit split) {
  LoadShareSums sums;
  for (const Contact& contact : packing.contacts) {
    const double share = branch_share(packing, contact);
    if (share == 0) continue;
    const double trace = share * contact.branch.dot(contact.force);
    const int fines =
        static_cast<int>(split.is_fine(packing.grains[static_cast<std::size_t>(contact.first)].radius)) +
        static_cast<int>(split.is_fine(second_radius(packing, contact)));
    (fines == 0 ? sums.coarse_coarse : fines == 1 ? sums.fine_coarse : sums.fine_fine) += trace;
  }
  return sums;
}

LoadShares load_shares(const LoadShareSums& sums) {
  const double all = sums.coarse_coarse + sums.fine_coarse + sums.fine_fine;
  if (all == 0) return {};
  return {sums.coarse_coarse / all, sums.fine_coarse / all, sums.fine_fine / all};
}

}  // namespace suffuse::micromechanics
