#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::micromechanics {

double normal_force(const Contact& contact) {
  return contact.force.dot(contact.branch.normalized());
}

double tangential_force(const Contact& contact) {
  const Vec3 normal = contact.branch.normalized();
  return (contact.force - contact.force.dot(normal) * normal).norm();
}

double overlap(const Packing& packing, const Contact& contact) {
  return first_grain(packing, contact).radius + second_radius(packing, contact) - contact.branch.norm();
}

double branch_share(const Packing& packing, const Contact& contact) {
  const double share = contact_share(packing, contact);
  if (share == 0 || share == 1) return share;
  const double arm = first_grain(packing, contact).radius - overlap(packing, contact) / 2;
  return arm / contact.branch.norm();
}

void add_image_contact(Packing& packing, Contact contact, const Image& image) {
  packing.images.push_back(image);
  contact.second = -static_cast<int>(packing.images.size());
  packing.contacts.push_back(contact);
}

}  // namespace suffuse::micromechanics
