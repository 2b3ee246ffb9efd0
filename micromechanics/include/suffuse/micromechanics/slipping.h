#pragma once

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// When a contact counts as sliding.
struct SlidingRule {
  double tolerance = 1e-6;  ///< sliding where S ≥ 1 − tolerance; covers rounding of a Coulomb-capped force
  bool frictionless_slides = true;  ///< a contact with μ = 0 gives no tangential constraint, so it slides

  /// Appendix G to the letter: S ≥ 1 exactly, where 0/0 of a frictionless contact is not ≥ 1. The share then
  /// changes with the rank count, since capped contacts lie within rounding of 1.
  static SlidingRule appendix() { return {0, false}; }
};

/// Mobilised friction f_T/f_N, dimensionless; 0 without normal force.
double mobilised_friction(const Contact& contact);

/// Slipping index S = f_T/(μ f_N), the mobilised friction normalised by the coefficient (thesis
/// eqs 5.10, 6.6). A frictionless contact (μ = 0) reports 1: its tangential force is at its limit. 0 without
/// normal force.
double slipping_index(const Contact& contact);

bool is_sliding(const Contact& contact, const SlidingRule& rule);

struct SlidingSums {
  double contacts = 0;
  double sliding = 0;
  double slipping_index = 0;      ///< Σ S
  double mobilised_friction = 0;  ///< Σ f_T/f_N
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
