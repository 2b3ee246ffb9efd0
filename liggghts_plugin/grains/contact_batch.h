#pragma once

/// A batch of touching pairs as structure of arrays, and the laws that act on one lane of it. Included by
/// contact_kernels.cpp alone, once for each instruction set.

#include "grains/contact_pass.h"

namespace suffuse::grains::SUFFUSE_KERNEL_NAMESPACE {

inline constexpr int kLanes = 64;

struct alignas(64) ContactBatch {
  // Geometry and motion: branch from second to first grain, relative velocity, spins, radii, 1/m_i + 1/m_j.
  double branch[3][kLanes], radii[kLanes], velocity[3][kLanes], inverse_mass[kLanes];
  double spin_first[3][kLanes], radius_first[kLanes], spin_second[3][kLanes], radius_second[kLanes];
  double spring[3][kLanes];
  // Material, one value a lane; filled once if there is one material.
  double normal_stiffness[kLanes], tangential_stiffness[kLanes], normal_damping[kLanes],
      tangential_damping[kLanes], friction[kLanes], rolling_friction[kLanes];
  // hooke: k_n, which takes a power.
  double linear_stiffness[kLanes];
  // Result: force on the first grain, moment of the tangential force for an arm of one, arms, rolling torque.
  double force[3][kLanes], moment[3][kLanes], arm_first[kLanes], arm_second[kLanes], rolling[3][kLanes];
  // Whose contacts these are.
  int first[kLanes], second[kLanes], motion[kLanes], receiver[kLanes];
  std::uint32_t pair[kLanes];
};

/// What a normal law gives for one contact.
struct Stiffness {
  double normal, tangential, normal_damping, tangential_damping;
};

struct HertzLaw {
  static constexpr bool needs_power = false;
  [[gnu::always_inline]] static Stiffness of(const ContactBatch& b, int lane, double overlap,
                                             const ContactLaw&) {
    const double E = b.normal_stiffness[lane], G = b.tangential_stiffness[lane];
    const double root =
        __builtin_sqrt(b.radius_first[lane] * b.radius_second[lane] / b.radii[lane] * overlap);
    const double mass_root = __builtin_sqrt(root / b.inverse_mass[lane]);
    return {4. / 3 * E * root, 8 * G * root, b.normal_damping[lane] * __builtin_sqrt(2 * E) * mass_root,
            b.tangential_damping[lane] * __builtin_sqrt(8 * G) * mass_root};
  }
};

struct HookeLaw {
  static constexpr bool needs_power = true;
  [[gnu::always_inline]] static Stiffness of(const ContactBatch& b, int lane, double, const ContactLaw&) {
    const double k = b.linear_stiffness[lane];
    const double root = __builtin_sqrt(k / b.inverse_mass[lane]);
    return {k, k * b.tangential_stiffness[lane], b.normal_damping[lane] * root,
            b.tangential_damping[lane] * root};
  }
};

struct HookeStiffnessLaw {
  static constexpr bool needs_power = false;
  [[gnu::always_inline]] static Stiffness of(const ContactBatch& b, int lane, double, const ContactLaw& law) {
    const double mass = law.absolute_damping ? 1 : 1 / b.inverse_mass[lane];
    return {b.normal_stiffness[lane], b.tangential_stiffness[lane], b.normal_damping[lane] * mass,
            b.tangential_damping[lane] * mass};
  }
};

/// Forces of all lanes. No branches that depend on a lane: the compiler turns the loop into vector code.
template <class Normal, TangentialLaw tangential, RollingLaw rolling, bool half_step>
[[gnu::noinline]] void forces_of(ContactBatch& b, const PassSettings& settings) {
  const ContactLaw law = settings.law;
  const double shift = 0.5 * settings.time_step;
  const double advance = settings.advance_springs ? settings.time_step : 0;
  const double project = settings.advance_springs ? 1 : 0;
  const double least_force = law.limit_force ? 0 : -__DBL_MAX__;
  const double torsion = law.torsion ? 0 : 1;
#pragma GCC ivdep
  for (int c = 0; c < kLanes; ++c) {
    const double dx = b.branch[0][c], dy = b.branch[1][c], dz = b.branch[2][c];
    const double distance = __builtin_sqrt(dx * dx + dy * dy + dz * dz), inverse = 1 / distance;
    const double overlap = b.radii[c] - distance;
    const double nx = dx * inverse, ny = dy * inverse, nz = dz * inverse;
    const Stiffness k = Normal::of(b, c, overlap, law);

    const double vx = b.velocity[0][c], vy = b.velocity[1][c], vz = b.velocity[2][c];
    const double vn = vx * nx + vy * ny + vz * nz;
    double Fn = k.normal * overlap - k.normal_damping * vn;
    Fn = Fn < least_force ? least_force : Fn;

    const double arm_first = b.radius_first[c] - 0.5 * overlap,
                 arm_second = b.radius_second[c] - 0.5 * overlap;
    double Tx = 0, Ty = 0, Tz = 0;  // tangential force
    if (tangential != TangentialLaw::off) {
      const double wx = arm_first * b.spin_first[0][c] + arm_second * b.spin_second[0][c];
      const double wy = arm_first * b.spin_first[1][c] + arm_second * b.spin_second[1][c];
      const double wz = arm_first * b.spin_first[2][c] + arm_second * b.spin_second[2][c];
      double mx = nx, my = ny, mz = nz, vm = vn;
      if (half_step) {
        const double ex = dx - shift * vx, ey = dy - shift * vy, ez = dz - shift * vz;
        const double ie = 1 / __builtin_sqrt(ex * ex + ey * ey + ez * ez);
        mx = ex * ie, my = ey * ie, mz = ez * ie;
        vm = vx * mx + vy * my + vz * mz;
      }
      const double tx = vx - vm * mx - (mz * wy - my * wz);
      const double ty = vy - vm * my - (mx * wz - mz * wx);
      const double tz = vz - vm * mz - (my * wx - mx * wy);
      const double limit = b.friction[c] * __builtin_fabs(Fn);
      if (tangential == TangentialLaw::no_history) {
        const double speed = __builtin_sqrt(tx * tx + ty * ty + tz * tz);
        const double viscous = k.tangential_damping * speed;
        const double gamma = limit < viscous ? limit / speed : k.tangential_damping;
        Tx = -gamma * tx, Ty = -gamma * ty, Tz = -gamma * tz;
      } else {
        double sx = b.spring[0][c], sy = b.spring[1][c], sz = b.spring[2][c];
        if (half_step) {
          const double sm = project * (sx * mx + sy * my + sz * mz);
          sx -= sm * mx, sy -= sm * my, sz -= sm * mz;
        }
        sx += advance * tx, sy += advance * ty, sz += advance * tz;
        const double sn = project * (sx * nx + sy * ny + sz * nz);
        sx -= sn * nx, sy -= sn * ny, sz -= sn * nz;
        const double elastic = k.tangential * __builtin_sqrt(sx * sx + sy * sy + sz * sz);
        const bool slides = elastic > limit;
        const double scale = slides ? limit / elastic : 1;
        const double damping = slides ? 0 : k.tangential_damping;
        sx *= scale, sy *= scale, sz *= scale;
        Tx = -k.tangential * sx - damping * tx;
        Ty = -k.tangential * sy - damping * ty;
        Tz = -k.tangential * sz - damping * tz;
        b.spring[0][c] = sx, b.spring[1][c] = sy, b.spring[2][c] = sz;
      }
    }
    b.force[0][c] = Fn * nx + Tx, b.force[1][c] = Fn * ny + Ty, b.force[2][c] = Fn * nz + Tz;
    b.moment[0][c] = ny * Tz - nz * Ty, b.moment[1][c] = nz * Tx - nx * Tz,
    b.moment[2][c] = nx * Ty - ny * Tx;
    b.arm_first[c] = arm_first, b.arm_second[c] = arm_second;
    if (rolling == RollingLaw::cdt) {
      double rx = b.spin_first[0][c] - b.spin_second[0][c], ry = b.spin_first[1][c] - b.spin_second[1][c],
             rz = b.spin_first[2][c] - b.spin_second[2][c];
      const double spin = __builtin_sqrt(rx * rx + ry * ry + rz * rz);
      const double size =
          b.rolling_friction[c] * k.normal * overlap * b.radius_first[c] * b.radius_second[c] / b.radii[c];
      const double factor = spin > 0 ? size / spin : 0;
      rx *= factor, ry *= factor, rz *= factor;
      const double along = torsion * (rx * nx + ry * ny + rz * nz);
      b.rolling[0][c] = rx - along * nx, b.rolling[1][c] = ry - along * ny, b.rolling[2][c] = rz - along * nz;
    }
  }
}

}  // namespace suffuse::grains::SUFFUSE_KERNEL_NAMESPACE
