#pragma once

// What `fix stress/servo` reads from the contacts of its sample.

#include <string>

namespace LAMMPS_NS {
class FixContactSampler;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace suffuse {

/// Of all grains on all ranks, at one step.
struct ServoNetwork {
  double grains = 0;
  double coordination = 0;    ///< Z = 2 contacts / grains
  double bulk_stiffness = 0;  ///< Voigt bound of the bulk modulus, Pa
  double unbalanced = 0;      ///< mean resultant force on a grain over mean contact force
  double overlap = 0;         ///< mean overlap of a contact over the smaller grain's diameter
};

/// Collective: one pass over the contacts of the sampler's step.
ServoNetwork measure_network(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::FixContactSampler& sampler, int group_bit);

/// A sample at a control step.
struct ServoSample {
  bool stress_is_finite = true;
  double void_ratio = 0;
  double grains_at_start = 0;
  const ServoNetwork* network = nullptr;  ///< the last measured
};

/// Throws UserError in the name of `who` where the sample cannot be one any more: stress or void ratio not
/// finite, void ratio below 0, fewer grains than the run began with, contacts that overlap by a fifth of a
/// grain on average.
void require_sound_sample(const std::string& who, const ServoSample& sample);

}  // namespace suffuse
