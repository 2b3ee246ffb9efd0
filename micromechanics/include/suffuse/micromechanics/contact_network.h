#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::micromechanics {

/// In an index of grains: that grain is owned by another rank, or not in the group.
inline constexpr int kNotOwned = -1;

/// One contact as seen from an owned grain.
///
/// A contact between two owned grains is listed once. A contact between an owned grain and an image (another
/// rank's grain, or a periodic image) is listed once for each owner, so that sums over a grain's own contacts
/// need no communication; of those listings exactly one, over all ranks, stands for the contact in sums over
/// contacts (contact_share).
///
/// 80 bytes: a dump of 1 GB has six million of them.
struct Contact {
  int first = 0;               ///< index into Packing::grains
  int second = 0;              ///< index into Packing::grains; negative: -1 - index into Packing::images
  Vec3 branch = Vec3::Zero();  ///< centre of second to centre of first, nearest image, m
  Vec3 force = Vec3::Zero();   ///< contact force on first, N
  double friction = 0;         ///< Coulomb coefficient of the pair, dimensionless
  /// What the contact law itself caps its tangential spring with, N, and the spring's force, N, without the
  /// damping that the law adds to it. NaN where only the whole force is known.
  double friction_limit = std::numeric_limits<double>::quiet_NaN();
  double spring_force = std::numeric_limits<double>::quiet_NaN();
};

/// What of its contact a listing stands for in sums over contacts.
enum class Listing {
  whole,
  elsewhere,  ///< nothing: the second grain's owner lists the contact, too, and that one stands for it
  own_half    ///< half: the second grain is not of the sample (part_inside)
};

/// The second grain of one listing that this rank does not own, or of which it is a periodic image, or that
/// is not of the sample.
struct Image {
  std::int64_t id = 0;  ///< identifier of the grain, unique over all ranks
  double radius = 0;    ///< m
  Listing listing = Listing::whole;
};

/// A grain that this rank owns.
struct Grain {
  std::int64_t id = 0;
  double radius = 0;             ///< m
  Vec3 position = Vec3::Zero();  ///< m
};

/// A contact of an owned grain with a wall.
struct WallContact {
  int grain = 0;               ///< index into Packing::grains
  Vec3 branch = Vec3::Zero();  ///< point of contact to the grain's centre, m
  Vec3 force = Vec3::Zero();   ///< on the grain, N
};

/// The part of a packing that one rank knows: its own grains and their contacts.
struct Packing {
  std::vector<Grain> grains;
  std::vector<Contact> contacts;
  std::vector<Image> images;
  std::vector<WallContact> walls;  ///< they count in stresses, and in nothing else; empty: left out
  double volume = 0;               ///< of the whole sample, voids included, over all ranks; m³
  Vec3 box_low =
      Vec3::Zero();  ///< corners of the box at the time of the contacts, m: a servo moves them within a
  Vec3 box_high = Vec3::Zero();  ///< step, after the forces
};

/// Is the second grain one of Packing::grains?
inline bool owns_second(const Contact& contact) {
  return contact.second >= 0;
}

/// The image in a contact whose second grain is none of Packing::grains.
inline const Image& image_of(const Packing& packing, const Contact& contact) {
  return packing.images[static_cast<std::size_t>(-1 - contact.second)];
}

/// What this listing counts in sums over contacts: 1, 0 or 1/2.
inline double contact_share(const Packing& packing, const Contact& contact) {
  if (owns_second(contact)) return 1;
  const Listing listing = image_of(packing, contact).listing;
  return listing == Listing::whole ? 1 : listing == Listing::own_half ? 0.5 : 0;
}

/// Does this listing stand for its contact, whole or by half?
inline bool is_counted(const Packing& packing, const Contact& contact) {
  return owns_second(contact) || image_of(packing, contact).listing != Listing::elsewhere;
}

inline const Grain& first_grain(const Packing& packing, const Contact& contact) {
  return packing.grains[static_cast<std::size_t>(contact.first)];
}

/// Radius of the second grain, m.
inline double second_radius(const Packing& packing, const Contact& contact) {
  return owns_second(contact) ? packing.grains[static_cast<std::size_t>(contact.second)].radius
                              : image_of(packing, contact).radius;
}

/// Identifier of the second grain.
inline std::int64_t second_id(const Packing& packing, const Contact& contact) {
  return owns_second(contact) ? packing.grains[static_cast<std::size_t>(contact.second)].id
                              : image_of(packing, contact).id;
}

/// Lists a contact of an owned grain with an image; contact.second is set here.
void add_image_contact(Packing& packing, Contact contact, const Image& image);

/// Normal force f·n, N; compression positive, a tensile contact (cohesion) has a negative one.
double normal_force(const Contact& contact);

/// Magnitude of the tangential force, |f − (f·n)n|, N.
double tangential_force(const Contact& contact);

/// Overlap of the two spheres, r₁ + r₂ − |branch|, m.
double overlap(const Packing& packing, const Contact& contact);

/// What this listing counts in sums of branch times force: 1, 0 or, of a contact with a grain that is not of
/// the sample, the part of the branch from the first grain's centre to the point of contact.
double branch_share(const Packing& packing, const Contact& contact);

}  // namespace suffuse::micromechanics
