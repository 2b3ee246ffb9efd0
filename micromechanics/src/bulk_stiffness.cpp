#include "suffuse/micromechanics/bulk_stiffness.h"

#include <cassert>

namespace suffuse::micromechanics {

double stiffness_length_sum(const Packing& packing, std::span<const double> normal_stiffness) {
  assert(normal_stiffness.size() == packing.contacts.size());
  double sum = 0;
  for (std::size_t i = 0; i < packing.contacts.size(); ++i) {
    const Contact& contact = packing.contacts[i];
    sum += branch_share(packing, contact) * normal_stiffness[i] * contact.branch.squaredNorm();
  }
  return sum;
}

double voigt_bulk_modulus(double sum, double volume) {
  return sum / (9 * volume);
}

}  // namespace suffuse::micromechanics
