#pragma once

#include <cstddef>
#include <vector>

/// A loading platen: a rigid plate across an axis that presses on a sample at a constant stress. Pure: no
/// LIGGGHTS, no MPI. SI units. Distances, velocities and forces along the axis count from the sample
/// outwards.
namespace suffuse::platen {

/// Of a grain and the platen together, as of two grains of which one is flat and cannot be moved: R* is the
/// grain's radius, m* its mass.
struct Material {
  double effective_modulus = 0;  ///< E*, Pa
  double damping = 0;            ///< 2 sqrt(5/6) |beta|, beta = ln e/sqrt(ln² e + π²); 0 without losses
};

/// E* of two materials: 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, Pa.
double effective_modulus(double youngs_first, double poisson_first, double youngs_second,
                         double poisson_second);

/// The damping factor of a coefficient of restitution 0 < e <= 1 (LIGGGHTS's `model hertz`).
double damping_factor(double restitution);

struct Reaction {
  double force = 0;      ///< on the grain inwards and on the platen outwards, N; >= 0
  double stiffness = 0;  ///< tangent, 2E*√(R δ), N/m
};

/// Hertz's force 4/3 E*√(R δ) δ and the damping of LIGGGHTS's `model hertz`, γ √(S_n m) v with S_n = 2E*√(R
/// δ) and v the speed of approach (m/s), together never attractive. `overlap` δ > 0, m; `radius` R, m;
/// `mass`, kg.
Reaction reaction(const Material& material, double radius, double mass, double overlap, double approach);

struct Motion {
  double position = 0;  ///< along the axis, m
  double velocity = 0;  ///< outwards, m/s
};

/// What drives a platen. M dw/dt = Σ F − P A − c w with c = 2 ζ √(k M), k the stiffness of all its contacts.
struct Drive {
  double load = 0;           ///< P A, N
  double mass = 0;           ///< M, kg, > 0
  double damping_ratio = 0;  ///< ζ, of the platen on its contacts
  double most_speed = 0;     ///< it never moves faster, m/s, > 0
};

/// One step of `step` seconds, implicit in the damping. `outward` is 1 where the sample lies below the platen
/// along the axis, −1 where it lies above. `all`: sums over the contacts.
void advance(Motion& motion, const Drive& drive, const Reaction& all, double outward, double step);

/// k step²/M: with more than 1 the platen shakes the grains instead of resting on them (an explicit step is
/// unstable from 4 on).
double stiffness_of_step(const Drive& drive, const Reaction& all, double step);

/// Numbers and masses of grains by classes of diameters: below the first bound, from the first to the second,
/// ..., from the last on.
class SizeTally {
 public:
  /// `bounds`: rising, m; none makes one class of all.
  explicit SizeTally(std::vector<double> bounds = {})
      : bounds_(std::move(bounds)), rows_(bounds_.size() + 1) {}

  struct Row {
    double grains = 0;
    double mass = 0;  ///< kg
  };

  std::size_t classes() const { return rows_.size(); }
  const std::vector<double>& bounds() const { return bounds_; }
  const Row& row(std::size_t k) const { return rows_[k]; }
  Row& row(std::size_t k) { return rows_[k]; }
  /// The class of a diameter, m.
  std::size_t class_of(double diameter) const;
  /// Of all classes.
  Row total() const;

 private:
  std::vector<double> bounds_;
  std::vector<Row> rows_;
};

}  // namespace suffuse::platen
