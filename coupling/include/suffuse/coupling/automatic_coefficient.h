#pragma once

#include <cstddef>
#include <vector>

#include "suffuse/coupling/mapped_sphere.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/instruction_set.h"
#include "suffuse/lbm/partial_solids.h"

namespace suffuse::coupling {

/// k of the viscosity-independent weighting for a sphere of diameter D (cells):
///
///   k = constant + (single + crowded x)/D + narrow (x/D)^2,  x = D/(6 m),  at most kLargestCoefficient,
///
/// where m is a hydraulic radius of the pores around the sphere, in cells: their volume (and 0.15 of the
/// ball's in which they are sought) over the surface of grains that they wet. In dense packings of equal
/// spheres x is about 0.75 phi/(1 - phi). Calibrated so that the permeability of arrays and random packings
/// is right at 5 to 20 cells a diameter (docs/decisions/solid-operator.md); valid for D >= 2.
struct CoefficientLaw {
  double constant = 0, single = 0, crowded = 0, narrow = 0;

  double operator()(double diameter, double crowding) const;
};

/// Coefficients beyond this are cut: strengths add up exactly in any order up to here.
inline constexpr double kLargestCoefficient = 15;

/// The law of an operator. A UserError for one that has none: `force` and `sc3` do.
CoefficientLaw coefficient_law(lbm::SolidOperator solid_operator);

/// Error of a packing's permeability (a share: 0.03 is 3 %) to be expected with `force`, the automatic
/// coefficient and so many cells a Sauter diameter: root mean square, and the largest, of what packings show
/// that were not fitted, 16 to 55 spheres in a periodic box (docs/decisions/solid-operator.md). Measured at 5
/// and 8 cells, a power of the resolution between; extrapolated, hence a guess, below 5; beyond 8 as at 8,
/// where the references are hardly better.
double expected_permeability_error(double cells_per_sauter_diameter);
double largest_permeability_error(double cells_per_sauter_diameter);

/// What one rank's cells tell of the pores around a sphere: lattice units.
struct PoreSums {
  double volume = 0, surface = 0;
};

/// x = D/(6 m) of a sphere from the sums of all ranks; 0 for a sphere alone.
double crowding_of(const PoreSums& sums, double radius);

/// Measures the pores around spheres in the cells of one rank.
///
/// A pore is where fluid is near to two spheres at least (of their radii: within kNear fully, beyond kFar not
/// at all), so that the open water above a bed, or a box's wall, does not thin out what the grains at its
/// edge see. Sums are over a ball of kReach radii about the sphere's centre with the weight 1 - (d/R)^2: the
/// spheres that touch it count, and fine grains among coarse ones see their own pores. Each rank must know
/// the spheres that are within twice their radius of its cells. The sums depend on how cells are divided
/// among ranks by round-off only (1e-12).
class PoreSurvey {
 public:
  static constexpr double kNear = 0.2, kFar = 1, kReach = 2;

  PoreSurvey(lbm::InstructionSet instruction_set, const lbm::PartialSolidArrays& arrays,
             const lbm::CellBox& local_box);

  /// Of each sphere, copies included, in this rank's cells. The fractions in the arrays must be up to date.
  std::vector<PoreSums> sums(const std::vector<LatticeSphere>& spheres);

  /// Memory that is held from the first survey on.
  std::size_t bytes() const { return (nearness_.capacity() + surface_.capacity()) * sizeof(float); }

 private:
  lbm::InstructionSet instruction_set_;
  lbm::PartialSolidArrays arrays_;
  lbm::CellBox box_;
  std::vector<float> nearness_, surface_;
};

}  // namespace suffuse::coupling
