#pragma once

#include <cstddef>
#include <vector>

#include "laws/grain_record.h"

namespace suffuse::coupling {

/// The spheres that one rank knows, in SI: those it owns first, then copies of others' (ghosts, periodic
/// images among them), which are where the image is. Vectors are x y z, one grain after the other.
struct GrainArrays {
  int owned = 0;
  int total = 0;                             ///< owned and copies
  const double* position = nullptr;          ///< 3 total, m
  const double* velocity = nullptr;          ///< 3 total, m/s
  const double* angular_velocity = nullptr;  ///< 3 total, rad/s
  const double* radius = nullptr;            ///< total, m
  const double* mass = nullptr;              ///< total, kg
  const int* id = nullptr;                   ///< total; a copy has its owner's
};

/// What stays with a grain from one fluid step to the next, wherever it migrates; SI, owned grains only.
struct GrainMemory {
  double* load = nullptr;  ///< 6 per grain, applied in every DEM step until the next fluid step: force (N),
                           ///< torque about the centre (N m)
  GrainRecord* record = nullptr;  ///< one per grain
};

/// What the cells of one sphere handed to it in a fluid step, SI; torque and spin about its centre.
struct GrainSums {
  double force[3]{};                    ///< N
  double torque[3]{};                   ///< N m
  double internal_fluid_momentum[3]{};  ///< InternalFluidMomentum::momentum, kg m/s
  double internal_fluid_spin[3]{};      ///< InternalFluidMomentum::spin, kg m^2/s
};

/// What the coupling asks of a discrete-element code.
class ParticlePort {
 public:
  virtual ~ParticlePort() = default;

  /// Reads the grains as they are now, and tells copies how their owners move. Collective: messages.
  virtual void refresh() = 0;

  /// What the last `refresh` read. Valid until `advance`.
  virtual GrainArrays grains() const = 0;

  /// Adds what copies hold to their owners, all of it in one exchange; one entry for each of `total` grains.
  /// Collective.
  virtual void sum_over_copies(std::vector<GrainSums>& sums) = 0;

  virtual GrainMemory memory() = 0;

  /// Will anything read the loads in the next so many DEM steps: something that moves a grain on any rank, or
  /// an output? They are formed in the fluid steps before as well, whose momentum they refer to. Otherwise
  /// they are computed when asked for. The same on all ranks.
  virtual bool reads_loads(int substeps) = 0;

  /// Grains' step, s.
  virtual double time_step() const = 0;

  /// Integrates the grains by so many steps with the loads in memory() and what its records say of the
  /// water's answer, of which they are told what was withheld. Collective.
  virtual void advance(int substeps) = 0;
};

}  // namespace suffuse::coupling
