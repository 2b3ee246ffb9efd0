#pragma once

#include <optional>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// First pass: what one rank adds to the mean normal force.
struct NormalForceSums {
  double contacts = 0;
  double normal_force = 0;  ///< Σ f_N, N
};

NormalForceSums normal_force_sums(const Packing& packing);

/// Mean f_N over contacts, N; 0 without contacts.
double mean_normal_force(const NormalForceSums& sums);

/// Second pass: contacts with f_N ≥ threshold are strong (Thornton & Antony 1998; thesis §6.5.2, where the
/// threshold is the mean of the hydrostatic state, frozen).
struct StrongSums {
  double contacts = 0;
  double strong = 0;
  TensorSum strong_stress;  ///< Σ l_i f_j over strong contacts, N·m
  TensorSum stress;         ///< Σ l_i f_j over all contacts, N·m
};

/// `threshold`: normal force, N.
StrongSums strong_sums(const Packing& packing, double threshold);

/// All 0 without contacts.
struct StrongContacts {
  double share = 0;              ///< strong contacts over all contacts
  double mean_stress_share = 0;  ///< share of p' that they carry; 0 where p' = 0
  /// Share of σ_aa − (σ_bb + σ_cc)/2, a the axis; none where that is below kIsotropyTolerance of p'.
  std::optional<double> deviator_share;
};

StrongContacts strong_contacts(const StrongSums& sums, int axis);

}  // namespace suffuse::micromechanics
