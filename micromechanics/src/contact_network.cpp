#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::micromechanics {

double normal_force(const Contact& contact) {
  return std::abs(contact.force.dot(contact.branch.normalized()));
}

double tangential_force(const Contact& contact) {
  const Vec3 normal = contact.branch.normalized();
  return (contact.force - contact.force.dot(normal) * normal).norm();
}

double overlap(const Contact& contact, double first_radius) {
  return first_radius + contact.second_radius - contact.branch.norm();
}

}  // namespace suffuse::micromechanics
