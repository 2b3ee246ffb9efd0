#pragma once

#include "suffuse/micromechanics/coordination.h"

namespace suffuse::micromechanics {

/// Constraints over degrees of freedom of a packing of spheres without rolling resistance (Cundall & Strack
/// 1983; thesis eq 6.7 and App. H). All three use the same share of sliding contacts.
struct ConstraintRatio {
  double mean = 0;        ///< R = N_c(3 − 2S_c)/(6N_p) = Z(3 − 2S_c)/12
  double geometric = 0;   ///< with Z_geo
  double mechanical = 0;  ///< with Z_mech
};

/// `sliding_share`: S_c, 0 to 1.
ConstraintRatio constraint_ratio(const Coordination& coordination, double sliding_share);

enum class HydromechanicalState {
  fluid_like,    ///< R < 1: fewer constraints than degrees of freedom
  transitional,  ///< R = 1
  stable         ///< R > 1: over-constrained
};

/// R within `tolerance` of 1 is transitional. The thesis draws the line at R ≈ 1 without a width.
HydromechanicalState hydromechanical_state(double constraint_ratio, double tolerance = 0.005);

/// A word for a report: "stable", "transitional", "fluid-like".
const char* to_string(HydromechanicalState state);

}  // namespace suffuse::micromechanics
