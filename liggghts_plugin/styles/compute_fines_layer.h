#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(fines/layer,ComputeFinesLayer)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_FINES_LAYER_H
#define SUFFUSE_COMPUTE_FINES_LAYER_H

#include "contact_compute.h"
#include "suffuse/micromechanics/layers.h"
#include "suffuse/micromechanics/slipping.h"

namespace LAMMPS_NS {

/// `compute ID group fines/layer AXIS N split DIAMETER bounds LO HI [from top|bottom] [by
/// contact_point|pair_halves] [tolerance T | appendix]`: what the fines of N layers along an axis are and
/// carry (global array, one row a layer; global vector of the whole column). Formulas:
/// micromechanics/layers.h.
class ComputeFinesLayer : public ContactCompute {
 public:
  ComputeFinesLayer(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void init() override;
  void compute_vector() override;
  void compute_array() override;

 private:
  struct Sums {
    std::vector<suffuse::micromechanics::LayerSums> grains;
    std::vector<suffuse::micromechanics::SlidingSums> contacts;
  };
  Sums sums();

  suffuse::micromechanics::LayerGrid grid_;
  suffuse::micromechanics::SizeSplit split_;
  suffuse::micromechanics::GrainArm arm_ = suffuse::micromechanics::GrainArm::pair_halves;
  suffuse::micromechanics::SlidingRule rule_;
};

}  // namespace LAMMPS_NS

#endif
#endif
