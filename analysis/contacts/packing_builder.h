#pragma once

#include <optional>
#include <string>

#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::analysis {

/// What a file tells of one contact.
struct RawContact {
  std::optional<Vec3> separation;  ///< x₁ − x₂ as written, before the nearest image, m
  std::optional<Vec3> force;       ///< on the first grain, N
  std::optional<Vec3> normal_force, tangential_force;  ///< on the first grain, N
  std::optional<double> overlap;                       ///< m
};

/// The branch and the force of a contact between grains whose radii add up to `reach` (m).
///
/// The direction is that of the normal force where that is given, and else of the separation: text of six
/// digits holds forces to 5e-6 of themselves, but a separation, which is a difference of positions, only to
/// some 5e-6 of the box. Its length is reach − overlap where the overlap is given. With both parts of the
/// force given the force is their sum, so that the slipping index is that of the parts. `period`: of the box
/// along periodic axes, 0 along others. Returns what is wrong with the contact, or an empty text.
std::string set_branch_and_force(const RawContact& raw, double reach, const Vec3& period, bool rounded,
                                 micromechanics::Contact& contact);

/// What is wrong with grains in this box, or an empty text: no grains, radii that are not positive, grains
/// larger than the box or solids that do not fit into the volume (units that do not belong together).
std::string problem_of_grains(const micromechanics::Packing& packing);

/// What is wrong with the contacts of a packing, or an empty text: a pair that is listed twice with one
/// branch (two through different periodic faces are two contacts), a grain in contact with itself (but with
/// its own image, a whole number of periods away), negative coefficients, limits or spring forces.
std::string problem_of_contacts(const micromechanics::Packing& packing, const Vec3& period);

/// How many rows of so many columns a file of so many bytes can have at most, at `least` bytes a value, and
/// 1032 times as many where it is compressed (deflate's limit): what a header claims is not allocated unseen.
std::size_t plausible_rows(std::int64_t claimed, std::int64_t bytes, std::size_t columns, bool compressed,
                           std::size_t least = 2);

/// Reads a number of a file as an identifier; none if it is no whole number from 1 to 2⁵³.
std::optional<std::int64_t> identifier(double value);

}  // namespace suffuse::analysis
