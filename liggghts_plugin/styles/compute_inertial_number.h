#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(inertial/number,ComputeInertialNumber)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_INERTIAL_NUMBER_H
#define SUFFUSE_COMPUTE_INERTIAL_NUMBER_H

#include <array>

#include "contact_compute.h"
#include "suffuse/micromechanics/mean_diameter.h"

namespace LAMMPS_NS {

/// `compute ID group inertial/number [diameter mass|number|d50|VALUE] [rate measured|VALUE]`: inertial number
/// I of thesis eq 3.17 (global vector). Formulas: micromechanics/inertial_number.h,
/// micromechanics/mean_diameter.h.
class ComputeInertialNumber : public ContactCompute {
 public:
  ComputeInertialNumber(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void init() override;
  void compute_vector() override;

 private:
  void remember_box();
  void measure_rate();
  double median_diameter_by_mass();

  suffuse::micromechanics::MeanDiameter kind_ = suffuse::micromechanics::MeanDiameter::mass;
  double given_diameter_ = 0;  // m; 0: take the mean
  bool rate_given_ = false;
  double rate_ = 0;  // 1/s
  std::array<double, 3> lengths_{};
  bigint lengths_step_ = -1;
  double dt_ = 0;        // s, then
  bigint run_end_ = -1;  // of the last run
};

}  // namespace LAMMPS_NS

#endif
#endif
