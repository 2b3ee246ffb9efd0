#pragma once

#include "suffuse/micromechanics/internal_stability.h"

namespace suffuse::micromechanics {

/// Boundaries of the thesis (key: haq) between stable and unstable at the scale of grains.
struct MicroscaleLimits {
  double coordination = 1;  ///< Z up to which a sample is unstable (chapter 4), Z_fc up to which fines are
                            ///< loose (chapter 5)
  double stress_reduction = 0.5;  ///< α up to which unstable (chapter 4), fines are under-stressed (chapter
                                  ///< 5); drawn with α by pair halves (Appendix F)
};

/// The thesis words its chapter 4 boundary in two ways.
enum class BoundaryWording {
  either,  ///< unstable if Z ≤ 1 or α ≤ 0.5 (sections 4.4.1, 4.5, 5.3.6)
  both     ///< unstable if Z ≤ 1 and α ≤ 0.5 "simultaneously" (section 1.3), "and" (7.2.1)
};

/// Chapter 4's verdict on a sample with the coordination number Z and the stress reduction factor α.
Verdict microscale_verdict(double coordination, double stress_reduction, BoundaryWording wording,
                           const MicroscaleLimits& limits = {});

/// Chapter 5's cases of fabric (section 5.3.7, Fig. 5.9), bounded by Z_fc = 1 and α = 0.5; the thesis has no
/// word on the boundary itself, which goes to the side where the fines carry less.
enum class FabricCase {
  loose_fines,        ///< I: Z_fc ≤ 1, α ≤ 0.5; fines lie loose in the voids
  supporting_fines,   ///< II: Z_fc > 1, α ≤ 0.5; coarse grains carry, fines support them
  overfilled,         ///< III: Z_fc > 1, α > 0.5; fines and coarse grains carry
  overstressed_fines  ///< IV: Z_fc ≤ 1, α > 0.5; a few fines are stuck between coarse grains
};

/// `fine_coarse`: Z_fc = 2(N_ff + N_fc)/N_fines (thesis eq 5.8).
FabricCase fabric_case(double fine_coarse, double stress_reduction, const MicroscaleLimits& limits = {});

/// "I", "II", "III", "IV", and what it means in a clause.
const char* to_string(FabricCase which);
const char* description(FabricCase which);

/// Zones of the fines content of a gap-graded soil (key: shire2014; thesis section 2.6).
enum class FinesZone {
  underfilled,   ///< below 25 %: fines loose in the voids, whatever the density
  transitional,  ///< 25 to 35 %: the stress on the fines depends on the density
  overfilled     ///< above 35 %: fines carry, stable
};
struct FinesZoneLimits {
  double underfilled = 0.25;  ///< below
  double overfilled = 0.35;   ///< above
};

/// `fines`: share of the solids, 0 to 1.
FinesZone fines_zone(double fines, const FinesZoneLimits& limits = {});
const char* to_string(FinesZone zone);
const char* description(FinesZone zone);

}  // namespace suffuse::micromechanics
