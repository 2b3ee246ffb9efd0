#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(stress/layer,ComputeStressLayer)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_STRESS_LAYER_H
#define SUFFUSE_COMPUTE_STRESS_LAYER_H

#include "contact_compute.h"
#include "suffuse/micromechanics/layers.h"

namespace LAMMPS_NS {

/// `compute ID group stress/layer AXIS N [bounds LO HI] [trim DISTANCE] [share volume|centre] [from
/// top|bottom] [by contact_point|pair_halves] [region ID | bed] [walls yes|no]`: stress, void ratio and
/// coordination of N layers along an axis (global array, one row a layer; global vector of the whole column).
/// Formulas: micromechanics/layers.h.
class ComputeStressLayer : public ContactCompute {
 public:
  ComputeStressLayer(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void init() override;
  void compute_vector() override;
  void compute_array() override;

 private:
  /// Puts the layers into the sample.
  void place_grid(const suffuse::micromechanics::Box& sample, const suffuse::Vec3& box_length);
  std::vector<suffuse::micromechanics::LayerSums> sums();

  suffuse::micromechanics::LayerGrid grid_;
  suffuse::micromechanics::GrainArm arm_ = suffuse::micromechanics::GrainArm::contact_point;
  bool bounds_given_ = false;
  double low_ = 0, high_ = 0;  // m, along the axis
  double trim_ = 0;            // m, off each side face
};

}  // namespace LAMMPS_NS

#endif
#endif
