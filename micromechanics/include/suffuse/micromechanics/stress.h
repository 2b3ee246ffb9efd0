#pragma once

#include <functional>
#include <vector>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// Which part of a contact's branch vector a grain takes for its own stress.
enum class GrainArm {
  contact_point,  ///< from its centre to the contact point, r − overlap/2 (thesis eq 4.2)
  pair_halves     ///< half of the branch, whatever the radii (App. F; LIGGGHTS's `stress/atom`)
};

/// One rank's part of V σ_ij = Σ_c l_i f_j over its contacts by branch_share, N·m. l: branch from second to
/// first grain, f: force on the first, so that compression is positive. Contacts with walls add (centre −
/// point of contact)_i f_j. No kinetic part (thesis eqs 4.1, 6.3).
TensorSum stress_times_volume(const Packing& packing);

/// V_p σ^p of each owned grain, N·m, in the order of Packing::grains (thesis eqs 4.2, 6.4); a contact with a
/// wall has the arm from the centre to the point of contact. Sum over the
/// grains of all ranks equals the sum over contacts, for either arm, if both ends of each contact belong to
/// the packing.
std::vector<Mat3> grain_stress_times_volume(const Packing& packing, GrainArm arm);

/// The same contact by contact, for sums that need no value a grain: calls `take` with the index of an owned
/// grain and what a contact adds to its V_p σ^p.
void for_each_grain_stress(const Packing& packing, GrainArm arm,
                           const std::function<void(int grain, const Mat3& stress_times_volume)>& take);

/// p' = (σ_xx + σ_yy + σ_zz)/3, compression positive (thesis eq 5.1).
double mean_stress(const Mat3& stress);

/// q = σ_aa − (σ_bb + σ_cc)/2, a the axis (0, 1, 2); signed: negative in extension along the axis.
double axial_deviatoric_stress(const Mat3& stress, int axis);

}  // namespace suffuse::micromechanics
