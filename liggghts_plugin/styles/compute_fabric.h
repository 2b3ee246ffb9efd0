#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(fabric,ComputeFabric)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_FABRIC_H
#define SUFFUSE_COMPUTE_FABRIC_H

#include "contact_compute.h"

namespace LAMMPS_NS {

/// `compute ID group fabric`: fabric tensor, its deviator and rose fits (global vector), orientation
/// histograms of the contact normals (global array, one row a bin). Formulas: micromechanics/fabric.h.
class ComputeFabric : public ContactCompute {
 public:
  ComputeFabric(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void compute_vector() override;
  void compute_array() override;
};

}  // namespace LAMMPS_NS

#endif
#endif
