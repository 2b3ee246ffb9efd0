#include "suffuse/micromechanics/broken_contacts.h"

#include <algorithm>

namespace suffuse::micromechanics {

GrainPair pair_of(const Packing& packing, const Contact& contact) {
  const std::int64_t first = first_grain(packing, contact).id, second = second_id(packing, contact);
  return {std::min(first, second), std::max(first, second)};
}

std::vector<GrainPair> contact_pairs(const Packing& packing) {
  std::vector<GrainPair> pairs;
  pairs.reserve(packing.contacts.size());
  for (const Contact& contact : packing.contacts)
    if (is_counted(packing, contact)) pairs.push_back(pair_of(packing, contact));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

BrokenSums broken_sums(const std::vector<GrainPair>& reference, const std::vector<GrainPair>& current) {
  std::vector<GrainPair> kept;
  std::set_intersection(reference.begin(), reference.end(), current.begin(), current.end(),
                        std::back_inserter(kept));
  return {static_cast<double>(reference.size()), static_cast<double>(current.size()),
          static_cast<double>(kept.size())};
}

BrokenContacts broken_contacts(const BrokenSums& sums) {
  if (sums.reference <= 0) return {};
  return {(sums.reference - sums.current) / sums.reference, (sums.reference - sums.kept) / sums.reference,
          (sums.current - sums.kept) / sums.reference};
}

}  // namespace suffuse::micromechanics
