#include "suffuse/micromechanics/coordination.h"

#include <numbers>

namespace suffuse::micromechanics {
namespace {

double ratio(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : 0;
}

}  // namespace

std::vector<int> contacts_per_grain(const Packing& packing) {
  std::vector<int> contacts(packing.grains.size(), 0);
  for (const Contact& contact : packing.contacts) {
    ++contacts[static_cast<std::size_t>(contact.first)];
    if (owns_second(contact)) ++contacts[static_cast<std::size_t>(contact.second)];
  }
  return contacts;
}

CoordinationSums coordination_sums(const Packing& packing, SizeSplit split) {
  CoordinationSums sums;
  const std::vector<int> contacts = contacts_per_grain(packing);
  for (std::size_t i = 0; i < packing.grains.size(); ++i) {
    const double radius = packing.grains[i].radius;
    const bool fine = split.is_fine(radius);
    sums.grains += 1;
    sums.fines += fine;
    sums.unconnected += contacts[i] == 0;
    sums.single_contact += contacts[i] == 1;
    sums.stable += contacts[i] >= 4;
    sums.unconnected_fines += fine && contacts[i] == 0;
    sums.contact_volume += contacts[i] * sphere_volume(radius);
  }
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    const bool first_fine = split.is_fine(packing.grains[static_cast<std::size_t>(contact.first)].radius);
    const bool second_fine = split.is_fine(second_radius(packing, contact));
    sums.contacts += share;
    (first_fine && second_fine   ? sums.fine_fine
     : first_fine || second_fine ? sums.fine_coarse
                                 : sums.coarse_coarse) += share;
  }
  return sums;
}

Coordination coordination(const CoordinationSums& sums, double volume) {
  const double connected = sums.grains - sums.unconnected;
  Coordination result;
  result.mean = ratio(2 * sums.contacts, sums.grains);
  result.mechanical = ratio(2 * sums.contacts - sums.single_contact, connected - sums.single_contact);
  result.geometric = ratio(2 * sums.contacts, connected);
  result.volume_weighted = ratio(sums.contact_volume, volume);
  result.coarse_coarse = ratio(2 * sums.coarse_coarse, sums.grains - sums.fines);
  result.fine_coarse = ratio(2 * (sums.fine_fine + sums.fine_coarse), sums.fines);
  result.fine_fine = ratio(2 * sums.fine_fine, sums.fines);
  result.fines_mean = ratio(2 * sums.fine_fine + sums.fine_coarse, sums.fines);
  result.unconnected_fines_share = ratio(sums.unconnected_fines, sums.fines);
  result.stable_share = ratio(sums.stable, sums.grains);
  return result;
}

}  // namespace suffuse::micromechanics
