#pragma once

#include <vector>

#include "suffuse/coupling/mapped_sphere.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/instruction_set.h"
#include "suffuse/lbm/partial_solids.h"

namespace suffuse::coupling {

/// k of the viscosity-independent weighting in a cell, for a sphere of diameter D (cells):
///
///   k = constant + single/D + crowded s/6 + narrow (s/6)^2,  at most kLargestCoefficient,
///
/// where s is the surface of grains per volume of pore around the cell, 1/cells: 6/s is the diameter of a
/// sphere with as much surface per volume as the pore has. D s/6 is 0.44 at the surface of a lone sphere, and
/// 0.6 to 1.5 in the mean of packings from phi = 0.2 to 0.62. Calibrated so that the permeability of arrays
/// and random packings is right at 5 to 20 cells a diameter (docs/decisions/solid-operator.md). Below a cell,
/// where the survey of pores no longer sees a sphere, a point in the water: 10 (D^-3/2 - 1) is added, with
/// which a lone sphere of 0.3 to 1 cells falls within 30 % of its speed in Stokes flow.
struct CoefficientLaw : lbm::CoefficientTerms {
  double of_sphere(double diameter) const;
  double of_pore(double surface_per_pore) const {
    return (crowded + narrow * surface_per_pore / 6) * surface_per_pore / 6;
  }
  double operator()(double diameter, double surface_per_pore) const;
};

/// The law of an operator (suffuse/lbm/solid_operators.h). A UserError for one that has none.
CoefficientLaw coefficient_law(lbm::SolidOperator solid_operator);

/// Error of a packing's permeability (a share: 0.03 is 3 %) to be expected with `force`, the automatic
/// coefficient and so many cells a Sauter diameter: root mean square of packings of 300 spheres, and the
/// largest of those of 16 to 300 (docs/results/data/resolution_of_packings.csv; periodic boxes, solid
/// fractions 0.4 to 0.62). Measured at 2 to 8 cells, powers of the resolution between; beyond 8 as at 8,
/// where the references are hardly better; a guess below 2. Pores of denser packings are narrower: a solid
/// fraction phi counts as sqrt(0.55/phi) times the cells, which leaves the least scatter between packings;
/// 0.5 to 0.65, beyond as there (looser packings err less, lone spheres more).
inline constexpr double kUsualSolidFraction = 0.55;
double expected_permeability_error(double cells_per_sauter_diameter,
                                   double solid_fraction = kUsualSolidFraction);
double largest_permeability_error(double cells_per_sauter_diameter,
                                  double solid_fraction = kUsualSolidFraction);

/// Measures the pores in the cells of one rank: the surface of grains in the neighbourhood of a cell over the
/// volume between them.
///
/// The neighbourhood of each sphere's surface and volume is its own radius: they are seen through the kernel
/// 1 - (t/R)^2, t < R the distance, so that fine grains and coarse ones count over their own size. Both are
/// radial functions of closed form about the sphere's centre. A twentieth is added to the volume between the
/// grains, which may come out as nothing. Walls count as nothing.
///
/// Each rank must know the spheres that are within twice their radius of its cells. Sums are of multiples of
/// 2^-20: the same in any order and on any number of ranks.
class PoreSurvey {
 public:
  static constexpr double kOpenShare = 0.05;

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
  std::size_t bytes() const { return (surface_.capacity() + solid_.capacity()) * sizeof(float); }

 private:
  std::size_t values_held() const;
  std::size_t place(int x, int y, int z) const;

  lbm::InstructionSet instruction_set_;
  std::ptrdiff_t row_pitch_, plane_pitch_;
  lbm::CellBox box_;
  std::vector<float> surface_, solid_;  ///< the first becomes the coefficient
};

}  // namespace suffuse::coupling
