#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(stress/reduction,ComputeStressReduction)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_STRESS_REDUCTION_H
#define SUFFUSE_COMPUTE_STRESS_REDUCTION_H

#include "contact_compute.h"
#include "suffuse/micromechanics/stress.h"

namespace LAMMPS_NS {

/// `compute ID group stress/reduction split DIAMETER [by contact_point|pair_halves]`: how much of the stress
/// the fines carry (global vector) and σ^p V_p of each grain (per-atom array). Formulas:
/// micromechanics/stress_reduction.h.
class ComputeStressReduction : public ContactCompute {
 public:
  ComputeStressReduction(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void compute_vector() override;
  void compute_peratom() override;

 private:
  suffuse::micromechanics::SizeSplit split_;
  suffuse::micromechanics::GrainArm arm_ = suffuse::micromechanics::GrainArm::contact_point;
  std::vector<double> components_;
  std::vector<double*> component_rows_;
};

/// The value of the keyword `by`: contact_point or pair_halves.
suffuse::micromechanics::GrainArm read_arm(suffuse::ArgumentReader& reader);

}  // namespace LAMMPS_NS

#endif
#endif
