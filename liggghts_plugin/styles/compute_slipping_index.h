#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(slipping/index,ComputeSlippingIndex)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_SLIPPING_INDEX_H
#define SUFFUSE_COMPUTE_SLIPPING_INDEX_H

#include "contact_compute.h"

namespace LAMMPS_NS {

/// `compute ID group slipping/index`: mobilised friction of every contact (local array). Formulas:
/// micromechanics/slipping.h.
class ComputeSlippingIndex : public ContactCompute {
 public:
  ComputeSlippingIndex(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void compute_local() override;

 private:
  std::vector<double> columns_;
  std::vector<double*> contact_rows_;
};

}  // namespace LAMMPS_NS

#endif
#endif
