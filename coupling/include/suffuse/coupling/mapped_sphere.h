#pragma once

namespace suffuse::coupling {

/// How the part of a cell that a sphere covers is computed.
enum class FractionMethod {
  exact,     ///< plane cut of the cell with the sphere's curvature; smooth in the position
  linear,    ///< linear in the distance from the surface (docs key: joneswilliams2017); smooth, fastest
  subcells,  ///< share of n^3 points inside (Appendix C's code: 5^3)
};

/// The coefficient of a sphere and its pores is cut at most at the first: strengths add up exactly in any
/// order up to there. Grains of quartz stand the second at any radius.
inline constexpr double kLargestCoefficient = 240, kSafeCoefficient = 60;

/// Where the coefficient of a sphere of `radius` cells is cut that weighs `density_ratio` times its water
/// (infinity: nothing moves it). One that may move is given more by its cells in a step than it can follow,
/// and gains speed without bound, where their coefficient is too large for its weight: in the pores of dense
/// gap-graded soils about 70 (density_ratio - 0.5) at radii of 1 to 2.8, 100 at 3.5, 240 and more at 4
/// (docs/decisions/solid-operator.md; case fines_in_dense_pores). One whose radius is below a cell is a point
/// in the water that no survey of pores sees well.
inline constexpr double largest_coefficient(double radius, double density_ratio) {
  if (radius < 1) return kSafeCoefficient;
  constexpr double least = 10;  // of what floats
  const double of_size = 5.1 * radius * radius;
  const double stood = (of_size < 42 ? 42 : of_size) * (density_ratio - 0.5);
  if (!(stood > least)) return least;
  return stood < kLargestCoefficient ? stood : kLargestCoefficient;
}

/// A sphere in lattice units: cells of the whole box, cell (0,0,0) reaching from 0 to 1; cells a step.
struct LatticeSphere {
  double position[3]{};
  double radius = 0;
  double velocity[3]{};
  double angular_velocity[3]{};                   ///< radians a step
  double coefficient = 1;                         ///< the sphere's part of k, used with own_coefficients
  double coefficient_share = 1;                   ///< k times this: see CoefficientLaw::share_at
  double largest_coefficient = kSafeCoefficient;  ///< where k is cut
  int id = 0;
};

/// What a sphere's cells handed to it in the last fluid step, lattice units; torque about its centre.
struct LatticeLoad {
  double force[3]{};
  double torque[3]{};
  /// Momentum, and angular momentum, by which the fluid that the sphere covers was ahead of the sphere after
  /// that step (lbm::HeldTerms).
  double internal_fluid_momentum[3]{};
  double internal_fluid_spin[3]{};
};

/// A sphere as it was last placed, as far as its cells need it, and which cells of this rank it may reach:
/// rows of packs of eight cells, numbered from the low corner of the sub-box.
struct MappedSphere {
  double position[3]{};
  double reach = 0;  ///< beyond this distance from the centre no cell's centre is that of a covered cell
  float radius = 0, coefficient = 1, coefficient_share = 1, largest_coefficient = 1, velocity[3]{},
        angular_velocity[3]{};
  float linear_offset = 0;     ///< of FractionMethod::linear, see linear_offset()
  int x_start = 0, packs = 0;  ///< no packs: none of this rank's cells
  int y_begin = 0, y_end = 0, z_begin = 0, z_end = 0;
};

/// The rows begin <= y < end of a block that a sphere reaches.
struct SliceRows {
  int begin, end;
};

}  // namespace suffuse::coupling
