#pragma once

#include <cstdint>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse {

/// A UserError of the command `who` where two grains have one number: contacts, histories and output would
/// mix them up. Collective.
void require_unique_grains(LAMMPS_NS::LAMMPS* lmp, const char* who);

/// Says, once for each mesh, where it reaches out of a periodic face: LIGGGHTS adds the copy of what is
/// outside, and grains there touch both. Collective.
void tell_meshes_beyond_periodic_faces(LAMMPS_NS::LAMMPS* lmp);

/// Says, once, that the periodic box is narrower than two diameters of its largest grain: a pair
/// may touch by two images then, and LIGGGHTS, which knows a contact by the two grains' numbers, gives both
/// the same tangential spring at each new list. Collective.
void tell_box_of_few_grains(LAMMPS_NS::LAMMPS* lmp);

/// The grains at the start of a run, to say at its end how many were lost: those that left the box through a
/// fixed face, which LIGGGHTS passes over in silence after `thermo_modify lost ignore`.
class GrainCensus {
 public:
  /// Collective.
  explicit GrainCensus(LAMMPS_NS::LAMMPS* lmp);
  /// Nothing where none were lost, or where a fix of the script takes grains away on purpose. Collective.
  void tell_lost() const;
  /// How many; 0 where a fix of the script takes grains away on purpose. Collective.
  std::int64_t lost() const;

 private:
  LAMMPS_NS::LAMMPS* lmp_;
  std::int64_t grains_, inserted_;
};

}  // namespace suffuse
