#include "suffuse/micromechanics/slipping.h"

namespace suffuse::micromechanics {

double mobilised_friction(const Contact& contact) {
  const double normal = normal_force(contact);
  return normal > 0 ? tangential_force(contact) / normal : 0;
}

double slipping_index(const Contact& contact) {
  if (normal_force(contact) <= 0) return 0;
  return contact.friction > 0 ? mobilised_friction(contact) / contact.friction : 1;
}

bool is_sliding(const Contact& contact, const SlidingRule& rule) {
  if (contact.friction <= 0) return rule.frictionless_slides;
  return slipping_index(contact) >= 1 - rule.tolerance;
}

SlidingSums sliding_sums(const Packing& packing, const SlidingRule& rule) {
  SlidingSums sums;
  for (const Contact& contact : packing.contacts) {
    if (!is_counted(packing, contact)) continue;
    sums.contacts += 1;
    sums.sliding += is_sliding(contact, rule);
    sums.slipping_index += slipping_index(contact);
    sums.mobilised_friction += mobilised_friction(contact);
  }
  return sums;
}

Sliding sliding(const SlidingSums& sums) {
  if (sums.contacts <= 0) return {};
  return {sums.sliding / sums.contacts, sums.slipping_index / sums.contacts,
          sums.mobilised_friction / sums.contacts};
}

}  // namespace suffuse::micromechanics
