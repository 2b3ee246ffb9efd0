#pragma once

#include <vector>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sphere.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// Fines are the grains whose diameter is below `diameter` (m). The default makes every grain coarse.
struct SizeSplit {
  double diameter = 0;

  bool is_fine(double radius) const { return 2 * radius < diameter; }
};

/// Number of contacts of each owned grain, in the order of Packing::grains. A grain that touches its own
/// periodic image has one contact for each side.
std::vector<int> contacts_per_grain(const Packing& packing);

/// What one rank adds to the coordination numbers; all are counts except `contact_volume`.
struct CoordinationSums {
  double grains = 0;
  double fines = 0;
  double unconnected = 0;        ///< grains without a contact, N₀
  double single_contact = 0;     ///< grains with one contact, N₁
  double stable = 0;             ///< grains with four or more contacts
  double unconnected_fines = 0;  ///< fines without a contact
  double contacts = 0;           ///< N_c
  double coarse_coarse = 0;
  double fine_coarse = 0;
  double fine_fine = 0;
  double contact_volume = 0;  ///< Σ C_p V_p, m³
};

CoordinationSums coordination_sums(const Packing& packing, SizeSplit split);

/// Coordination numbers. Where a class has no grains its numbers are 0.
struct Coordination {
  double mean = 0;                     ///< Z = 2N_c/N_p (thesis eq 4.6)
  double mechanical = 0;               ///< (2N_c − N₁)/(N_p − N₀ − N₁) (App. E; `thornton2000`)
  double geometric = 0;                ///< 2N_c/(N_p − N₀) (App. E)
  double volume_weighted = 0;          ///< Σ C_p V_p / V with the voids in V (App. E; `shaebani2012`)
  double coarse_coarse = 0;            ///< 2N_cc/N_coarse (eq 5.9)
  double fine_coarse = 0;              ///< 2(N_ff + N_fc)/N_fines (eq 5.8)
  double fine_fine = 0;                ///< 2N_ff/N_fines
  double fines_mean = 0;               ///< contacts of a fine grain, (2N_ff + N_fc)/N_fines (CN_FF of App. F)
  double unconnected_fines_share = 0;  ///< by number, 0 to 1
  double stable_share = 0;             ///< M_s = N(≥ 4 contacts)/N_p, unconnected grains in N_p (eq 6.5)
};

/// `volume`: of the whole sample, voids included, m³; the volume-weighted number is 0 where it is not
/// positive.
Coordination coordination(const CoordinationSums& sums, double volume);

}  // namespace suffuse::micromechanics
