#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// Two grains in contact, the smaller identifier first, so that a pair is the same on every rank.
struct GrainPair {
  std::int64_t low = 0;
  std::int64_t high = 0;

  auto operator<=>(const GrainPair&) const = default;
};

/// The two grains of a contact, the lower identifier first.
GrainPair pair_of(const Packing& packing, const Contact& contact);

/// Pairs of the contacts that this rank counts, those with a grain outside of the sample too, sorted. A pair
/// that touches twice (across a small periodic box) is listed twice.
std::vector<GrainPair> contact_pairs(const Packing& packing);

/// What one rank adds. Pairs may be shared out over ranks in any way, as long as equal pairs meet on one
/// rank.
struct BrokenSums {
  double reference = 0;  ///< contacts of the reference state
  double current = 0;    ///< contacts now
  double kept = 0;       ///< reference contacts that still exist
};

/// Both lists sorted.
BrokenSums broken_sums(const std::vector<GrainPair>& reference, const std::vector<GrainPair>& current);

/// Contact losses as shares of the reference number (thesis §6.5.3, B_R; it does not say net or gross, and
/// the values printed agree with the net loss). All 0 where the reference has no contacts.
struct BrokenContacts {
  double net = 0;     ///< (N_ref − N_now)/N_ref; negative when contacts were gained
  double gross = 0;   ///< reference contacts that are gone
  double formed = 0;  ///< contacts now that were not in the reference; net = gross − formed
};

BrokenContacts broken_contacts(const BrokenSums& sums);

}  // namespace suffuse::micromechanics
