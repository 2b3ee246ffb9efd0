#include "suffuse/micromechanics/microscale_verdicts.h"

namespace suffuse::micromechanics {

Verdict microscale_verdict(double coordination, double stress_reduction, BoundaryWording wording,
                           const MicroscaleLimits& limits) {
  const bool few_contacts = coordination <= limits.coordination;
  const bool low_stress = stress_reduction <= limits.stress_reduction;
  const bool unstable =
      wording == BoundaryWording::either ? few_contacts || low_stress : few_contacts && low_stress;
  return unstable ? Verdict::unstable : Verdict::stable;
}

FabricCase fabric_case(double fine_coarse, double stress_reduction, const MicroscaleLimits& limits) {
  const bool in_contact = fine_coarse > limits.coordination;
  if (stress_reduction > limits.stress_reduction)
    return in_contact ? FabricCase::overfilled : FabricCase::overstressed_fines;
  return in_contact ? FabricCase::supporting_fines : FabricCase::loose_fines;
}

const char* to_string(FabricCase which) {
  switch (which) {
    case FabricCase::loose_fines:
      return "I";
    case FabricCase::supporting_fines:
      return "II";
    case FabricCase::overfilled:
      return "III";
    case FabricCase::overstressed_fines:
      break;
  }
  return "IV";
}

const char* description(FabricCase which) {
  switch (which) {
    case FabricCase::loose_fines:
      return "fines lie loose in the voids of the coarse grains; their loss hardly disturbs these";
    case FabricCase::supporting_fines:
      return "the coarse grains carry the load and the fines support them; a loss of fines can break the "
             "fabric";
    case FabricCase::overfilled:
      return "the fines touch each other and carry load as the coarse grains do";
    case FabricCase::overstressed_fines:
      break;
  }
  return "few fines have contacts; those that are stuck between coarse grains are over-stressed";
}

FinesZone fines_zone(double fines, const FinesZoneLimits& limits) {
  if (fines < limits.underfilled) return FinesZone::underfilled;
  return fines > limits.overfilled ? FinesZone::overfilled : FinesZone::transitional;
}

const char* to_string(FinesZone zone) {
  switch (zone) {
    case FinesZone::underfilled:
      return "underfilled";
    case FinesZone::transitional:
      return "transitional";
    case FinesZone::overfilled:
      break;
  }
  return "overfilled";
}

const char* description(FinesZone zone) {
  switch (zone) {
    case FinesZone::underfilled:
      return "fines lie loose in the voids, whatever the density";
    case FinesZone::transitional:
      return "the stress on the fines depends much on the density";
    case FinesZone::overfilled:
      break;
  }
  return "fines separate the coarse grains and carry load; stable";
}

}  // namespace suffuse::micromechanics
