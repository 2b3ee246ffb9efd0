#include "suffuse/micromechanics/strong_contacts.h"

#include <cmath>

#include "suffuse/micromechanics/stress.h"
#include "suffuse/micromechanics/stress_reduction.h"

namespace suffuse::micromechanics {

NormalForceSums normal_force_sums(const Packing& packing) {
  NormalForceSums sums;
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    sums.contacts += share;
    sums.normal_force += share * normal_force(contact);
  }
  return sums;
}

double mean_normal_force(const NormalForceSums& sums) {
  return sums.contacts > 0 ? sums.normal_force / sums.contacts : 0;
}

StrongSums strong_sums(const Packing& packing, double threshold) {
  StrongSums sums;
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    const Mat3 term = branch_share(packing, contact) * contact.branch * contact.force.transpose();
    sums.contacts += share;
    sums.stress.add(term);
    if (normal_force(contact) < threshold) continue;
    sums.strong += share;
    sums.strong_stress.add(term);
  }
  return sums;
}

StrongContacts strong_contacts(const StrongSums& sums, int axis) {
  StrongContacts result;
  if (sums.contacts <= 0) return result;
  result.share = sums.strong / sums.contacts;
  const Mat3 stress = sums.stress.matrix();
  const Mat3 strong = sums.strong_stress.matrix();
  if (mean_stress(stress) == 0) return result;
  result.mean_stress_share = mean_stress(strong) / mean_stress(stress);
  const double deviator = axial_deviatoric_stress(stress, axis);
  if (std::abs(deviator) > kIsotropyTolerance * std::abs(mean_stress(stress)))
    result.deviator_share = axial_deviatoric_stress(strong, axis) / deviator;
  return result;
}

}  // namespace suffuse::micromechanics
