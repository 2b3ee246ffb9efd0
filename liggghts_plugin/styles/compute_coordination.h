#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(coordination,ComputeCoordination)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_COORDINATION_H
#define SUFFUSE_COMPUTE_COORDINATION_H

#include "contact_compute.h"

namespace LAMMPS_NS {

/// `compute ID group coordination [split DIAMETER]`: coordination numbers (global vector) and the number of
/// contacts of each grain (per-atom vector). Formulas: micromechanics/coordination.h.
class ComputeCoordination : public ContactCompute {
 public:
  ComputeCoordination(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void compute_vector() override;
  void compute_peratom() override;

 private:
  suffuse::micromechanics::SizeSplit split_;
  std::vector<double> contacts_of_atom_;
};

}  // namespace LAMMPS_NS

#endif
#endif
