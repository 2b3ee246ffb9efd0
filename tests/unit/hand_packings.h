#pragma once

// Packings whose contacts, forces and stress are known by hand, for the tests of micromechanics/.

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::micromechanics::testing {

/// Force on the first grain of a contact, from the branch (second to first) and the two radii.
using ForceLaw = std::function<Vec3(const Vec3& branch)>;

/// Repulsion of constant magnitude.
inline ForceLaw push(double magnitude) {
  return [magnitude](const Vec3& branch) -> Vec3 { return magnitude * branch.normalized(); };
}

/// Adds every touching pair of a periodic box, nearest images, each listed once.
inline void add_periodic_contacts(Packing& packing, const Vec3& period, const ForceLaw& force,
                                  double friction) {
  const int n = static_cast<int>(packing.grains.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const Grain& a = packing.grains[static_cast<std::size_t>(i)];
      const Grain& b = packing.grains[static_cast<std::size_t>(j)];
      Vec3 branch = a.position - b.position;
      for (int axis = 0; axis < 3; ++axis)
        branch[axis] -= period[axis] * std::round(branch[axis] / period[axis]);
      // Lattice neighbours touch at exactly r1 + r2 up to rounding.
      if (branch.norm() > (a.radius + b.radius) * (1 + 1e-9)) continue;
      packing.contacts.push_back({i, j, branch, force(branch), friction});
    }
}

inline Grain grain(std::int64_t id, double radius, const Vec3& position) {
  return {id, radius, position};
}

/// n³ spheres on a periodic simple cubic lattice, n ≥ 3, pushed by `law`. Z = 6.
inline Packing simple_cubic(int n, double radius, const ForceLaw& law, double friction = 0.3) {
  Packing packing;
  const double a = 2 * radius;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        packing.grains.push_back(grain(static_cast<std::int64_t>(packing.grains.size()) + 1, radius,
                                       Vec3((x + 0.5) * a, (y + 0.5) * a, (z + 0.5) * a)));
  packing.volume = std::pow(n * a, 3);
  add_periodic_contacts(packing, Vec3::Constant(n * a), law, friction);
  return packing;
}

/// 4n³ spheres on a periodic face-centred cubic lattice, n ≥ 2, pushed by `law`. Z = 12.
inline Packing face_centred_cubic(int n, double radius, const ForceLaw& law, double friction = 0.3) {
  Packing packing;
  const double a = 2 * std::sqrt(2.0) * radius;
  const Vec3 basis[4] = {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}};
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        for (const Vec3& offset : basis)
          packing.grains.push_back(grain(static_cast<std::int64_t>(packing.grains.size()) + 1, radius,
                                         a * (Vec3(x + 0.25, y + 0.25, z + 0.25) + offset)));
  packing.volume = std::pow(n * a, 3);
  add_periodic_contacts(packing, Vec3::Constant(n * a), law, friction);
  return packing;
}

/// The same packing as `ranks` ranks see it: grain i belongs to rank i mod ranks, contacts across ranks are
/// listed by both owners and counted by one.
inline std::vector<Packing> shared_out(const Packing& whole, int ranks) {
  std::vector<Packing> parts(static_cast<std::size_t>(ranks));
  std::vector<int> local(whole.grains.size());
  for (std::size_t i = 0; i < whole.grains.size(); ++i) {
    Packing& part = parts[i % parts.size()];
    local[i] = static_cast<int>(part.grains.size());
    part.grains.push_back(whole.grains[i]);
    part.volume = whole.volume;
  }
  for (const Contact& contact : whole.contacts) {
    const auto first = static_cast<std::size_t>(contact.first),
               second = static_cast<std::size_t>(contact.second);
    Contact listed = contact;
    listed.first = local[first];
    if (first % parts.size() == second % parts.size()) {
      listed.second = local[second];
      parts[first % parts.size()].contacts.push_back(listed);
      continue;
    }
    const Grain &one = whole.grains[first], &two = whole.grains[second];
    add_image_contact(parts[first % parts.size()], listed, {two.id, two.radius, Listing::whole});
    Contact other = contact;
    other.first = local[second];
    other.branch = -contact.branch;
    other.force = -contact.force;
    add_image_contact(parts[second % parts.size()], other, {one.id, one.radius, Listing::elsewhere});
  }
  return parts;
}

}  // namespace suffuse::micromechanics::testing
