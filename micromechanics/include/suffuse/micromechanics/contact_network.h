#pragma once

#include <cstdint>
#include <vector>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::micromechanics {

/// Index of a contact's second grain when that grain is owned by another rank or is a periodic image.
inline constexpr int kNotOwned = -1;

/// One contact as seen from an owned grain.
///
/// A contact between two owned grains is listed once. A contact between an owned grain and an image (another
/// rank's grain, or a periodic image) is listed once for each owner, so that sums over a grain's own contacts
/// need no communication; of those listings exactly one, over all ranks, has `counted` set.
struct Contact {
  int first = 0;              ///< index into Packing::grains
  int second = kNotOwned;     ///< index into Packing::grains, or kNotOwned
  bool counted = true;        ///< this listing stands for the contact in sums over contacts
  std::int64_t first_id = 0;  ///< grain identifiers, unique over all ranks
  std::int64_t second_id = 0;
  Vec3 branch = Vec3::Zero();  ///< centre of second to centre of first, nearest image, m
  Vec3 force = Vec3::Zero();   ///< contact force on first, N
  double second_radius = 0;    ///< m
  double friction = 0;         ///< Coulomb coefficient of the pair, dimensionless
};

/// A grain that this rank owns.
struct Grain {
  std::int64_t id = 0;
  double radius = 0;             ///< m
  Vec3 position = Vec3::Zero();  ///< m
};

/// The part of a packing that one rank knows: its own grains and their contacts.
struct Packing {
  std::vector<Grain> grains;
  std::vector<Contact> contacts;
  double volume = 0;  ///< of the whole sample, voids included, over all ranks; m³
  Vec3 box_low =
      Vec3::Zero();  ///< corners of the box at the time of the contacts, m: a servo moves them within a
  Vec3 box_high = Vec3::Zero();  ///< step, after the forces
};

/// Magnitude of the normal force, |f·n|, N.
double normal_force(const Contact& contact);

/// Magnitude of the tangential force, |f − (f·n)n|, N.
double tangential_force(const Contact& contact);

/// Overlap of the two spheres, r₁ + r₂ − |branch|, m; `first_radius` in m.
double overlap(const Contact& contact, double first_radius);

}  // namespace suffuse::micromechanics
