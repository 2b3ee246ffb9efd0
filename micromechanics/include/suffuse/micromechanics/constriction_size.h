#pragma once

#include <array>
#include <span>
#include <vector>

#include "suffuse/micromechanics/grading.h"

namespace suffuse::micromechanics {

/// What the probability to meet a grain of a class is proportional to.
enum class FractionBy {
  mass,         ///< m_i
  number,       ///< m_i/d_i³
  surface_area  ///< m_i/d_i (Humes; the thesis's choice)
};

/// Shares of the classes, adding up to 1.
std::vector<double> class_fractions(std::span<const GradingClass> classes, FractionBy by);

/// How the hole between four grains is measured.
enum class LoosePore {
  inscribed,  ///< disc that touches all four: 0.4142 D between equal grains. Reproduces the thesis's
              ///< Table 4.1
  equal_area  ///< disc of the largest free area (Locke et al. 2001): 0.5227 D between equal grains
};

/// Disc between three grains that touch each other (dense arrangement), m: Descartes's circle theorem
/// 2/D_c = Σk + 2√(k1k2 + k2k3 + k3k1), k = 2/D (keys: locke2001, indraratna2007). 0.1547 D for equal grains.
double three_grain_constriction(double d1, double d2, double d3);

/// Hole in a ring of four grains, each touching the next (loose arrangement), m; opposite grains touch at
/// most. By area: for the shape of the ring in which it is largest. Inscribed: for the shape in which a disc
/// touches all four, which is the largest disc of any shape, or 0.2 % below it beside a small grain.
/// `diameters` in ring order.
double four_grain_constriction(const std::array<double, 4>& diameters, LoosePore pore);

/// Free area inside such a ring with the angle `angle` at its first grain (key: locke2001), m²; −1 where no
/// ring has this angle or opposite grains would overlap: 1/8[(D1+D2)(D1+D4) sin a + (D2+D3)(D3+D4) sin c −
/// (aD1² + bD2² + cD3² + dD4²)].
double four_grain_area(const std::array<double, 4>& diameters, double angle);

/// A cumulative distribution of sizes: straight between the points, which are rising in both.
struct SizeDistribution {
  std::vector<double> diameters;  ///< m
  std::vector<double> finer;      ///< 0 to 1: half of the size's own share counted as finer
  double quantile(double share) const;
  double finer_at(double diameter) const;
};

/// From sizes with weights (any order, any total).
SizeDistribution size_distribution(std::vector<std::pair<double, double>> weighted_sizes);

/// Constrictions of all triples of grains drawn by `fractions`: C(n+2, 3) of them.
SizeDistribution dense_constrictions(std::span<const GradingClass> classes,
                                     std::span<const double> fractions);
/// Of all quadruples, C(n+3, 4), each in its three ring orders with a third of its probability, as grains
/// drawn in random order would come.
SizeDistribution loose_constrictions(std::span<const GradingClass> classes, std::span<const double> fractions,
                                     LoosePore pore);

/// Both ends of one soil.
struct ConstrictionSizes {
  SizeDistribution dense, loose;
  /// D_c(P) = D_cD + P(1 − R_d)(D_cL − D_cD), P and R_d in 0 to 1 (keys: locke2001, indraratna2007), m.
  double at(double share, double relative_density) const;
};

ConstrictionSizes constriction_sizes(std::span<const GradingClass> classes, FractionBy by, LoosePore pore);

/// Mean diameter of Kovacs's parallel tubes, 4 n/(1−n) D_h/α_d (thesis eq 2.5; key: kovacs1981), m.
/// `shape`: α_d, 6 for spheres. `porosity` of these classes alone as the skeleton.
double kovacs_pore_diameter(std::span<const GradingClass> classes, double porosity, double shape = 6);

/// Porosity of the coarse grains alone when the fines (share `fines` of the solids) count as voids: n +
/// F(1−n).
double skeleton_porosity(double porosity, double fines);

}  // namespace suffuse::micromechanics
