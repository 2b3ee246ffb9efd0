#pragma once

#include <vector>

#include "suffuse/coupling/mapped_sphere.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/instruction_set.h"
#include "suffuse/lbm/partial_solids.h"

namespace suffuse::coupling {

/// k of the viscosity-independent weighting in a cell, for a sphere of diameter D (cells):
///
///   k = constant + single/D + crowded q + narrow q^2 + tight q^4,  q = s/6,
///
/// cut at LatticeSphere::largest_coefficient, where s is the surface of grains per volume of pore around the
/// cell, 1/cells: 1/q is the diameter of a sphere with as much surface per volume as the pore has. D q is
/// 0.44 at the surface of a lone sphere, and 0.6 to 1.5 in the mean of packings from phi = 0.2 to 0.62.
/// Calibrated so that the permeability of arrays and random packings is right from 5 cells a diameter on, and
/// of packings, within some per cent, from 2.5 on (docs/decisions/solid-operator.md). Below a cell, where the
/// survey of pores no longer sees a sphere, a point in the water: 10 (D^-3/2 - 1) is added, with which a lone
/// sphere of 0.3 to 1 cells falls within 30 % of its speed in Stokes flow.
struct CoefficientLaw : lbm::CoefficientTerms {
  double of_sphere(double diameter) const;
  double of_pore(double surface_per_pore) const {
    const double q = surface_per_pore / 6;
    return (crowded + (narrow + tight * q * q) * q) * q;
  }
  /// What k is multiplied with where a sphere moves through the lattice, 1/(1 + swept `speed`): `speed` is
  /// (|V_x| + |V_y| + |V_z|)/nu in lattice units, cells that it enters in the time in which momentum spreads
  /// by one. Cells that it sweeps act as their mean over the way, since the water has no time to follow them,
  /// and that mean drags more than the cells of a sphere at rest.
  double share_at(double speed) const { return 1 / (1 + swept * speed); }
};

/// The law of an operator (suffuse/lbm/solid_operators.h). A UserError for one that has none.
CoefficientLaw coefficient_law(lbm::SolidOperator solid_operator);

/// Error of a packing's permeability (a share: 0.03 is 3 %) to be expected with `force`, the automatic
/// coefficient and so many cells a Sauter diameter: root mean square of packings of 16 to 300 spheres, and
/// the largest (docs/results/data/resolution_of_packings.csv, coefficient_fit_force.csv; periodic boxes,
/// solid fractions 0.4 to 0.62; arrays of 0.34 err up to twice as much below five cells). Measured at 2 to 8
/// cells, powers of the resolution between; beyond 8 as at 8, where the references are hardly better; a guess
/// below 2. Grains of loose packings stand beside wide pores, where the law gives too little at two to four
/// cells: from a solid fraction of 0.52 down the cells count less, by 0.88 at 0.45 to 0.4, and as they are
/// from 0.3. Pores of dense packings are narrower: above 0.55 the cells count less, by the square root of the
/// porosity over 0.45, up to 0.8 (samples of the thesis's gradings, 0.72 to 0.785:
/// tests/data/gap_graded_packings.csv).
inline constexpr double kUsualSolidFraction = 0.55;
double expected_permeability_error(double cells_per_sauter_diameter,
                                   double solid_fraction = kUsualSolidFraction);
double largest_permeability_error(double cells_per_sauter_diameter,
                                  double solid_fraction = kUsualSolidFraction);

/// Measures the pores in the cells of one rank: the surface of grains in the neighbourhood of a cell over the
/// volume between them.
///
/// Each sphere's surface and volume are seen through a window 1 - (t/L)^2, t < L the distance. L is the
/// sphere's own radius, so that fine grains and coarse ones count over their own size; but where finer ones
/// fill that range, `reach` times the mean radius of the surfaces around the cell (each seen through the
/// window of its own radius) or kShortestRange, the larger, if that is less: a coarse grain's surface is not
/// in the pores between the fines beside it. Both are radial functions of closed form about the sphere's
/// centre. A twentieth is added to the volume between the grains, which may come out as nothing. Walls count
/// as nothing.
///
/// Each rank must know the spheres that are within twice their radius of its cells. Sums are of multiples of
/// 2^-20: the same in any order and on any number of ranks.
class PoreSurvey {
 public:
  static constexpr double kOpenShare = 0.05;
  /// Cells. Fines of two or three cells have too little drag; with windows as wide as this a coarse grain
  /// beside them makes up for a third of it (docs/decisions/solid-operator.md).
  static constexpr float kShortestRange = 4;

  /// Values are laid out as those of `arrays`.
  PoreSurvey(lbm::InstructionSet instruction_set, const lbm::PartialSolidArrays& arrays,
             const lbm::CellBox& local_box);

  /// Finds law.of_pore in each of this rank's cells.
  void update(const std::vector<LatticeSphere>& spheres, const CoefficientLaw& law);
  /// What `update` found, laid out as the fractions; null before.
  const float* coefficients() const { return surface_.empty() ? nullptr : surface_.data(); }

  /// The same cell by cell, x fastest; empty before.
  std::vector<float> values() const;
  void set_values(const std::vector<float>& values);

  /// Memory that is held from the first survey on.
  std::size_t bytes() const {
    return (surface_.capacity() + solid_.capacity() + range_.capacity()) * sizeof(float);
  }

 private:
  std::size_t values_held() const;
  std::size_t place(int x, int y, int z) const;

  lbm::InstructionSet instruction_set_;
  std::ptrdiff_t row_pitch_, plane_pitch_;
  lbm::CellBox box_;
  std::vector<float> surface_, solid_;  ///< the first becomes the coefficient
  std::vector<float> range_;            ///< where sizes differ
};

}  // namespace suffuse::coupling
