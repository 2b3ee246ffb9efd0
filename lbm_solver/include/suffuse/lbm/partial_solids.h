#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/solid_operators.h"

namespace suffuse::lbm {

struct PartialSolidSettings {
  SolidOperator solid_operator = SolidOperator::force;
  SolidWeighting weighting = SolidWeighting::viscosity_independent;
  /// k of the viscosity-independent weighting, the same in every cell; with `own_coefficients` each solid
  /// brings its own and this one is not used.
  double coefficient = 1;
  bool own_coefficients = false;
};

std::string name_of(SolidOperator solid_operator);
std::vector<std::pair<std::string, SolidOperator>> solid_words();
std::string name_of(SolidWeighting weighting);

/// A UserError where the settings cannot work: a coefficient that is not positive, coefficients with another
/// weighting than the viscosity-independent one.
void check(const PartialSolidSettings& settings);

/// Sums over the solids s that cover one cell: of eps_s, of the strength k_s eps_s (eps_s itself unless
/// solids have coefficients of their own), and of strength_s * velocity_s (lattice units, at the cell's
/// centre).
struct PartialSolidCell {
  double fraction = 0;
  double strength = 0;
  Vec3 momentum = Vec3::Zero();
};

/// B of a cell, 0 to 1; where fractions add up to more than one they shrink in proportion.
double solid_weight(const PartialSolidSettings& settings, const PartialSolidCell& cell,
                    double relaxation_time);

/// Share of the solids in the velocity of a cell over a step: the momentum before it and that after it, which
/// is what streams, have this mean. Half of the operator's `share` times B, see HeldTerms.
double mean_share(const PartialSolidSettings& settings, const PartialSolidCell& cell, double relaxation_time);

/// In one step the momentum of a cell comes nearer to its solid's by B (SC1, SC2) or 2B (SC3, `force`) of the
/// difference, and the exchange is what it gives. So after the step the cell is still
/// exchange (1/share - 1) away; times the covered part eps that is
///   exchange eps (base + (slope (1 - eps) + least)/strength)
/// with the cell's strength, for every weighting.
struct HeldTerms {
  double base = 0, slope = 0, least = 0;
};
HeldTerms held_terms(const PartialSolidSettings& settings, double relaxation_time);

/// Momentum that the fluid handed to the solids of each cell, for each unit of their strength, one array for
/// each component, in the storage type of the fluid: a solid's share is this times its own strength.
using ExchangeArrays = std::variant<std::array<const double*, 3>, std::array<const float*, 3>>;

/// The arrays of one rank that solids are written to and the exchange is read from. All pointers are to inner
/// cell (0,0,0) of the sub-box; cell (x,y,z) lies at x + row_pitch*y + plane_pitch*z. At least eight values
/// past the last cell of a row may be read, and written with what they hold.
///
/// Sums are kept in float. Fractions that are multiples of 2^-22 add up exactly, whatever the order.
struct PartialSolidArrays {
  float* fraction = nullptr;
  float* strength = nullptr;  ///< the same array as `fraction` unless own_coefficients
  std::array<float*, 3> momentum{};
  std::ptrdiff_t row_pitch = 0, plane_pitch = 0;

  /// Of the last step: defined where the fraction is not zero.
  ExchangeArrays exchange;
};

}  // namespace suffuse::lbm
