// The laws once more, as LIGGGHTS's documentation has them, for one contact after the other.

#include <Eigen/Geometry>
#include <cmath>

#include "grains/contact_pass.h"
#include "suffuse/common/linear_algebra.h"

namespace suffuse::grains {

namespace {

Vec3 vector_of(const Quad& q) {
  return {q.x, q.y, q.z};
}
void add(Quad& to, const Vec3& v) {
  to.x += v.x(), to.y += v.y(), to.z += v.z();
}

struct Coefficients {
  double k_n, k_t, gamma_n, gamma_t;
};

Coefficients coefficients(const ContactLaw& law, const PairCoefficients& pair, double reduced_radius,
                          double mass, double overlap) {
  switch (law.normal) {
    case NormalLaw::hertz: {
      const double contact_radius = std::sqrt(reduced_radius * overlap);
      const double S_n = 2 * pair.normal_stiffness * contact_radius;
      const double S_t = 8 * pair.tangential_stiffness * contact_radius;
      return {2. / 3 * S_n, S_t, pair.normal_damping * std::sqrt(S_n * mass),
              pair.tangential_damping * std::sqrt(S_t * mass)};
    }
    case NormalLaw::hooke: {
      const double V = law.characteristic_velocity, root = std::sqrt(reduced_radius);
      const double k = 16. / 15 * root * pair.normal_stiffness *
                       std::pow(15 * mass * V * V / (16 * root * pair.normal_stiffness), 0.2);
      return {k, k * pair.tangential_stiffness, pair.normal_damping * std::sqrt(mass * k),
              pair.tangential_damping * std::sqrt(mass * k)};
    }
    default: {
      const double factor = law.absolute_damping ? 1 : mass;
      return {pair.normal_stiffness, pair.tangential_stiffness, pair.normal_damping * factor,
              pair.tangential_damping * factor};
    }
  }
}

/// Projection on the plane across a unit normal.
Vec3 across(const Vec3& v, const Vec3& normal) {
  return v - v.dot(normal) * normal;
}

struct Contact {
  Vec3 normal, normal_then, relative_velocity, surface_spin;
  double normal_force;
};

Vec3 tangential_force(const PassSettings& settings, const Coefficients& k, double friction,
                      const Contact& contact, Quad& spring) {
  const Vec3 slip = across(contact.relative_velocity, contact.normal_then) +
                    contact.normal_then.cross(contact.surface_spin);
  const double limit = friction * std::abs(contact.normal_force);
  if (settings.law.tangential == TangentialLaw::off) return Vec3::Zero();
  if (settings.law.tangential == TangentialLaw::no_history) {
    const double viscous = k.gamma_t * slip.norm();
    return -(viscous > limit ? limit / slip.norm() : k.gamma_t) * slip;
  }
  const bool touched = spring.w >= settings.pass_number - 1;
  Vec3 stretch = touched || !settings.drop_lost_springs ? vector_of(spring) : Vec3::Zero();
  if (settings.advance_springs) {
    if (settings.half_step_normal) stretch = across(stretch, contact.normal_then);
    stretch = across(stretch + settings.time_step * slip, contact.normal);
  }
  Vec3 force = -k.k_t * stretch;
  if (force.norm() > limit) {
    force *= limit / force.norm();
    stretch = -force / k.k_t;
  } else {
    force -= k.gamma_t * slip;
  }
  if (settings.advance_springs) spring = {stretch.x(), stretch.y(), stretch.z(), settings.pass_number};
  return force;
}

}  // namespace

std::size_t reference_contact_pass(const CandidatePairs& candidates, const GrainArrays& grains,
                                   const PassSettings& settings, Quad* springs, const PassOutput& output) {
  const ContactLaw& law = settings.law;
  std::size_t touching = 0;
  for (std::size_t k = 0; k < candidates.count; ++k) {
    const int i = candidates.first[k], j = candidates.second[k], motion = candidates.motion[k];
    const Vec3 branch = vector_of(grains.position[i]) - vector_of(grains.position[j]);
    const double radius_i = grains.position[i].w, radius_j = grains.position[j].w;
    if (branch.squaredNorm() >= (radius_i + radius_j) * (radius_i + radius_j)) continue;
    ++touching;

    const int material_i = law.materials > 1 ? grains.material[i] : 0;
    const int material_j = law.materials > 1 ? grains.material[motion] : 0;
    const PairCoefficients& pair = law.coefficients[material_i * law.materials + material_j];
    const double overlap = radius_i + radius_j - branch.norm();
    const double reduced_radius = radius_i * radius_j / (radius_i + radius_j);
    const double mass = 1 / (grains.velocity[i].w + grains.velocity[motion].w);
    const Coefficients c = coefficients(law, pair, reduced_radius, mass, overlap);
    const double arm_i = radius_i - 0.5 * overlap, arm_j = radius_j - 0.5 * overlap;

    Contact contact;
    contact.normal = branch.normalized();
    contact.relative_velocity = vector_of(grains.velocity[i]) - vector_of(grains.velocity[motion]);
    contact.normal_then = contact.normal;
    if (settings.half_step_normal)
      contact.normal_then = (branch - 0.5 * settings.time_step * contact.relative_velocity).normalized();
    contact.surface_spin = arm_i * vector_of(grains.spin[i]) + arm_j * vector_of(grains.spin[motion]);
    contact.normal_force = c.k_n * overlap - c.gamma_n * contact.relative_velocity.dot(contact.normal);
    if (law.limit_force && contact.normal_force < 0) contact.normal_force = 0;

    const Vec3 tangential = tangential_force(settings, c, pair.friction, contact, springs[k]);
    const Vec3 force = contact.normal_force * contact.normal + tangential;
    const Vec3 moment = contact.normal.cross(tangential);
    Vec3 roll = Vec3::Zero();
    const Vec3 rolling_spin = vector_of(grains.spin[i]) - vector_of(grains.spin[motion]);
    if (law.rolling == RollingLaw::cdt && rolling_spin.norm() > 0) {
      roll = pair.rolling_friction * c.k_n * overlap * reduced_radius * rolling_spin.normalized();
      if (!law.torsion) roll = across(roll, contact.normal);
    }

    if (output.loads != nullptr) {
      add(output.loads[i].force, force);
      add(output.loads[i].torque, -arm_i * moment - roll);
      add(output.loads[candidates.receiver[k]].force, -force);
      add(output.loads[candidates.receiver[k]].torque, -arm_j * moment + roll);
    }
    const int rows[6] = {0, 1, 2, 0, 0, 1}, columns[6] = {0, 1, 2, 1, 2, 2};
    const bool both = candidates.receiver[k] < output.owned;
    for (int d = 0; d < 6; ++d) {
      const double half = 0.5 * branch[rows[d]] * force[columns[d]];
      if (output.virial != nullptr) output.virial[d] += both ? 2 * half : half;
      if (output.grain_virial == nullptr) continue;
      output.grain_virial[6 * i + d] += half;
      if (both) output.grain_virial[6 * candidates.receiver[k] + d] += half;
    }
    if (output.note != nullptr) {
      const Vec3 torque = -arm_i * moment - roll, other = -arm_j * moment + roll;
      output.note(output.listener, {static_cast<std::uint32_t>(k),
                                    {force.x(), force.y(), force.z()},
                                    {torque.x(), torque.y(), torque.z()},
                                    {other.x(), other.y(), other.z()}});
    }
  }
  return touching;
}

}  // namespace suffuse::grains
