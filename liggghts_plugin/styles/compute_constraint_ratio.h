#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(constraint/ratio,ComputeConstraintRatio)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_CONSTRAINT_RATIO_H
#define SUFFUSE_COMPUTE_CONSTRAINT_RATIO_H

#include "contact_compute.h"
#include "suffuse/micromechanics/slipping.h"

namespace LAMMPS_NS {

/// `compute ID group constraint/ratio [tolerance T | appendix]`: constraints over degrees of freedom (global
/// vector). Formulas: micromechanics/constraint_ratio.h.
class ComputeConstraintRatio : public ContactCompute {
 public:
  ComputeConstraintRatio(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void compute_vector() override;

 private:
  suffuse::micromechanics::SlidingRule rule_;
};

}  // namespace LAMMPS_NS

#endif
#endif
