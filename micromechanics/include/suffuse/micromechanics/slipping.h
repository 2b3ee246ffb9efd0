#pragma once

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// When a contact counts as sliding.
struct SlidingRule {
  double tolerance = 1e-6;  ///< sliding where S ≥ 1 − tolerance; covers rounding of a Coulomb-capped force
  bool frictionless_slides = true;  ///< a contact with μ = 0 gives no tangential constraint, so it slides
  bool by_total_force = false;      ///< |f_T| ≥ μ |f_N| of the whole force, damping and cohesion in it

  /// Appendix G to the letter: S ≥ 1 exactly, of the whole force, where 0/0 of a frictionless contact is not
  /// ≥ 1. The share then changes with the rank count, since capped contacts lie within rounding of 1.
  static SlidingRule appendix() { return {0, false, true}; }
};

/// Are the law's own limit and spring known, Contact::friction_limit and spring_force?
bool knows_the_law(const Contact& contact);

/// Slipping index S = f_T/(μ f_N), the mobilised friction normalised by the coefficient (thesis
/// eqs 5.10, 6.6), 0 to 1. μ f_N is the limit that the contact law itself sets: in LIGGGHTS cohesion is added
/// behind the cap (but for `tangential_reduce`), so that f_N is not the contact's whole normal force; where
/// the limit is not known it is μ |f·n|. Damping, which LIGGGHTS adds to springs below their limit, can bring
/// f_T above it: S is 1 then, and the contact does not slide.
///
/// A frictionless contact (no limit) reports 1; 0 without normal force where the limit is not known.
double slipping_index(const Contact& contact);

/// Mobilised friction μ S, dimensionless.
double mobilised_friction(const Contact& contact);

/// Only the whole force is known, and it is above the limit by more than `tolerance` of it: a sliding contact
/// that was evaluated once more at other velocities, or damping, or a limit that is not μ |f·n|.
bool is_above_limit(const Contact& contact, double tolerance);

/// Is the spring within `tolerance` of its limit? Where only the whole force is known: S ≥ 1 − tolerance,
/// which in quasi-static states errs in few contacts (contacts_above_limit() are the doubtful ones).
bool is_sliding(const Contact& contact, const SlidingRule& rule);

/// Contacts that is_above_limit() is true for.
std::int64_t contacts_above_limit(const Packing& packing, double tolerance);

struct SlidingSums {
  double contacts = 0;
  double sliding = 0;
  double slipping_index = 0;      ///< Σ S
  double mobilised_friction = 0;  ///< Σ μ S

  /// Counts a contact as this share of one.
  void add(const Contact& contact, const SlidingRule& rule, double share);
};

SlidingSums sliding_sums(const Packing& packing, const SlidingRule& rule);

/// Shares and means over contacts; all 0 without contacts.
struct Sliding {
  double share = 0;  ///< S_c: sliding contacts over all contacts, 0 to 1 (App. G)
  double mean_slipping_index = 0;
  double mean_mobilised_friction = 0;
};

Sliding sliding(const SlidingSums& sums);

}  // namespace suffuse::micromechanics
