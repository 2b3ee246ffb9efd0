#pragma once

#include <vector>

#include "fix_nve_sphere.h"

namespace LAMMPS_NS {

/// LIGGGHTS's `fix nve/sphere` with loops over flat arrays, which the compiler turns into vector code. The
/// same operations in the same order a grain, so that positions and velocities are the same to the last bit.
/// Options (dipoles, added mass) are left to LIGGGHTS's loop.
class FixNVESphereVector : public FixNVESphere {
 public:
  using FixNVESphere::FixNVESphere;
  void initial_integrate(int vflag) override;
  void final_integrate() override;

 private:
  bool plain() const;
  /// Half a step of velocity and spin, and with `moves` a step of position, for grains first <= i < end, all
  /// of the fix's group.
  void advance(int first, int end, bool moves);
  void advance_group(bool moves);

  std::vector<double> per_mass_, per_inertia_;  // of a block of grains, three times each
};

}  // namespace LAMMPS_NS
