#include "suffuse/micromechanics/slipping.h"

#include <algorithm>
#include <cmath>

namespace suffuse::micromechanics {

namespace {

/// f_T/(μ |f_N|) of the whole force; 0 without normal force.
double index_of_force(const Contact& contact) {
  const double limit = contact.friction * std::abs(normal_force(contact));
  return limit > 0 ? tangential_force(contact) / limit : 0;
}

}  // namespace

bool knows_the_law(const Contact& contact) {
  return !std::isnan(contact.friction_limit) && !std::isnan(contact.spring_force);
}

double slipping_index(const Contact& contact) {
  if (contact.friction <= 0) return !knows_the_law(contact) && normal_force(contact) == 0 ? 0 : 1;
  if (!knows_the_law(contact)) return std::min(index_of_force(contact), 1.0);
  return contact.friction_limit > 0 ? std::min(tangential_force(contact) / contact.friction_limit, 1.0) : 1;
}

double mobilised_friction(const Contact& contact) {
  return contact.friction * slipping_index(contact);
}

bool is_above_limit(const Contact& contact, double tolerance) {
  return contact.friction > 0 && !knows_the_law(contact) && index_of_force(contact) > 1 + tolerance;
}

bool is_sliding(const Contact& contact, const SlidingRule& rule) {
  if (contact.friction <= 0) return rule.frictionless_slides;
  if (knows_the_law(contact) && !rule.by_total_force)
    return contact.spring_force >= (1 - rule.tolerance) * contact.friction_limit;
  return index_of_force(contact) >= 1 - rule.tolerance;
}

std::int64_t contacts_above_limit(const Packing& packing, double tolerance) {
  return std::count_if(packing.contacts.begin(), packing.contacts.end(), [&](const Contact& contact) {
    return is_counted(packing, contact) && is_above_limit(contact, tolerance);
  });
}

void SlidingSums::add(const Contact& contact, const SlidingRule& rule, double share) {
  contacts += share;
  sliding += is_sliding(contact, rule) ? share : 0;
  slipping_index += share * suffuse::micromechanics::slipping_index(contact);
  mobilised_friction += share * suffuse::micromechanics::mobilised_friction(contact);
}

SlidingSums sliding_sums(const Packing& packing, const SlidingRule& rule) {
  SlidingSums sums;
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share > 0) sums.add(contact, rule, share);
  }
  return sums;
}

Sliding sliding(const SlidingSums& sums) {
  if (sums.contacts <= 0) return {};
  return {sums.sliding / sums.contacts, sums.slipping_index / sums.contacts,
          sums.mobilised_friction / sums.contacts};
}

}  // namespace suffuse::micromechanics
