#pragma once

#include "fix_nve_sphere.h"
#include "suffuse/simd/instruction_set.h"

namespace LAMMPS_NS {

/// LIGGGHTS's `fix nve/sphere` with vector code: the same operations in the same order a grain, which differ
/// from LIGGGHTS's by the rounding of fused multiplications and additions. Options (dipoles, added mass) are
/// left to LIGGGHTS's loop.
class FixNVESphereVector : public FixNVESphere {
 public:
  using FixNVESphere::FixNVESphere;
  void initial_integrate(int vflag) override;
  void final_integrate() override;

 private:
  bool plain() const;
  /// Half a step of velocity and spin, and with `moves` a step of position.
  void advance_group(bool moves);

  suffuse::InstructionSet instruction_set_ = suffuse::default_instruction_set();
};

}  // namespace LAMMPS_NS
