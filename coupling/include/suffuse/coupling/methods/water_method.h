#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/coupling/particle_port.h"
#include "suffuse/lbm/boundary.h"

namespace suffuse::coupling {

/// What a method knows of the water in a cell, SI.
struct WaterCell {
  Vec3 flux = Vec3::Zero();        ///< volume of water and grains together that moves, m^3 per m^2 and s
  Vec3 solid_flux = Vec3::Zero();  ///< of it the grains'
  double solid_fraction = 0;
  double pressure = 0;  ///< Pa above the reference, in excess of the hydrostatic one
};

/// Values of the six faces, SI, in LIGGGHTS's order. Kinds never change.
struct WaterFace {
  lbm::FaceKind kind = lbm::FaceKind::no_slip;
  Vec3 velocity = Vec3::Zero();  ///< m/s
  double pressure = 0;           ///< Pa
};
using WaterFaces = std::array<WaterFace, lbm::kFaces>;

/// State of a method as named arrays, the same on all ranks.
using WaterState = std::vector<std::pair<std::string, std::vector<double>*>>;
using ConstWaterState = std::vector<std::pair<std::string, const std::vector<double>*>>;

/// A way to compute the water other than the resolved lattice, behind CoupledSimulation: spheres go in, their
/// loads and means over cells come out. Everything in SI; cells are numbered over the whole box, and every
/// rank knows all of them.
class WaterMethod {
 public:
  virtual ~WaterMethod() = default;

  /// Fields as the grains are now, without a step. Collective.
  virtual void place(const GrainArrays& grains) = 0;

  /// Advances the water by one step with the grains as they are and move. Collective.
  virtual void step(const GrainArrays& grains) = 0;

  /// What the water did to each owned grain in the last step, N, without its buoyancy by gravity.
  virtual const std::vector<Vec3>& forces() const = 0;
  /// Inertia (kg) to be added to a grain's own, so that loads that are constant over a step cannot drive it
  /// past the water; none where the step is short enough.
  virtual const std::vector<double>& virtual_masses() const = 0;
  /// Is a grain in the water? Those beyond faces that are not periodic are dry.
  virtual bool is_wet(std::size_t grain) const = 0;

  virtual WaterCell at(const lbm::Index3& cell) const = 0;

  /// From the next step on.
  virtual void set_faces(const WaterFaces& faces) = 0;
  virtual void set_pressure_gradient(const Vec3& pascal_per_m) = 0;

  /// Largest speed of the water, m/s, and whether all values are finite.
  virtual double largest_speed() const = 0;
  virtual bool is_finite() const = 0;

  virtual WaterState state() = 0;
  virtual ConstWaterState state() const = 0;
  /// A line about method and closures.
  virtual std::string summary() const = 0;
  virtual std::size_t bytes() const = 0;
};

}  // namespace suffuse::coupling
