#pragma once

#include <vector>

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
  const double* mass = nullptr;              ///< owned, kg
  const int* id = nullptr;                   ///< total; a copy has its owner's
};

/// What stays with a grain from one fluid step to the next, wherever it migrates; SI, owned grains only.
struct GrainMemory {
  double* force = nullptr;   ///< 3 owned, N: applied in every DEM step until the next fluid step
  double* torque = nullptr;  ///< 3 owned, N m
  /// 13 per grain: velocity and angular velocity that the last fluid step saw (6), its exchange force and
  /// torque (6), and 1 once there was such a step.
  double* history = nullptr;
};
inline constexpr int kHistoryLength = 13;

/// What the coupling asks of a discrete-element code.
class ParticlePort {
 public:
  virtual ~ParticlePort() = default;

  /// Positions, velocities and copies as they are now. Collective. Valid until `advance`.
  virtual GrainArrays grains() = 0;

  /// Adds what copies hold to their owners: force and torque have 3 values for each of `total` grains.
  /// Collective.
  virtual void sum_over_copies(std::vector<double>& force, std::vector<double>& torque) = 0;

  virtual GrainMemory memory() = 0;

  /// Does anything move any grain on any rank? Otherwise loads are computed when asked for, and `advance` is
  /// never called.
  virtual bool any_mobile() const = 0;

  /// Grains' step, s.
  virtual double time_step() const = 0;

  /// Integrates the grains by so many steps with the loads in memory(). Collective.
  virtual void advance(int substeps) = 0;
};

}  // namespace suffuse::coupling
