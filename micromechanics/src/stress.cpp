#include "suffuse/micromechanics/stress.h"

namespace suffuse::micromechanics {
namespace {

/// Length from the centre of a grain of `radius` to the contact point, in a contact with this overlap.
double arm_length(double radius, double overlap_length, double distance, GrainArm arm) {
  return arm == GrainArm::contact_point ? radius - overlap_length / 2 : distance / 2;
}

}  // namespace

TensorSum stress_times_volume(const Packing& packing) {
  TensorSum sum;
  for (const Contact& contact : packing.contacts) {
    const double share = branch_share(packing, contact);
    if (share > 0) sum.add(share * contact.branch * contact.force.transpose());
  }
  for (const WallContact& wall : packing.walls) sum.add(wall.branch * wall.force.transpose());
  return sum;
}

void for_each_grain_stress(const Packing& packing, GrainArm arm,
                           const std::function<void(int grain, const Mat3& stress_times_volume)>& take) {
  for (const Contact& contact : packing.contacts) {
    const double distance = contact.branch.norm();
    const double overlap_length = overlap(packing, contact);
    const Mat3 unit = contact.branch / distance * contact.force.transpose();
    take(contact.first,
         arm_length(first_grain(packing, contact).radius, overlap_length, distance, arm) * unit);
    if (owns_second(contact))
      take(contact.second, arm_length(second_radius(packing, contact), overlap_length, distance, arm) * unit);
  }
  for (const WallContact& wall : packing.walls) take(wall.grain, wall.branch * wall.force.transpose());
}

std::vector<Mat3> grain_stress_times_volume(const Packing& packing, GrainArm arm) {
  std::vector<Mat3> stress(packing.grains.size(), Mat3::Zero());
  for_each_grain_stress(
      packing, arm, [&](int grain, const Mat3& part) { stress[static_cast<std::size_t>(grain)] += part; });
  return stress;
}

double mean_stress(const Mat3& stress) {
  return stress.trace() / 3;
}

double axial_deviatoric_stress(const Mat3& stress, int axis) {
  return stress(axis, axis) - (stress.trace() - stress(axis, axis)) / 2;
}

}  // namespace suffuse::micromechanics
