#pragma once

#include <span>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// Which mean of the grading stands for "the" grain diameter.
enum class MeanDiameter {
  number,  ///< Σ d / N
  mass,    ///< Σ d V / Σ V, grains of one density
  d50      ///< half of the mass is in grains up to this diameter
};

struct DiameterSums {
  double grains = 0;
  double diameter = 0;         ///< Σ d, m
  double volume = 0;           ///< Σ V, m³
  double diameter_volume = 0;  ///< Σ d V, m⁴
};

DiameterSums diameter_sums(const Packing& packing);

/// Means over number and mass, m; 0 without grains. For MeanDiameter::d50 use diameter_finer_than.
double mean_diameter(const DiameterSums& sums, MeanDiameter which);

/// The diameter of the grain at which the cumulative volume, from the smallest up, reaches `share` of the
/// total (0.5: d50), m. `diameters` of all grains of all ranks, any order. No interpolation between sizes; 0
/// if empty.
double diameter_finer_than(std::span<const double> diameters, double share);

}  // namespace suffuse::micromechanics
