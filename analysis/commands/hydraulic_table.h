#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "suffuse/micromechanics/grading.h"
#include "suffuse/micromechanics/seepage.h"

namespace suffuse::analysis {

/// What gradients and conductivities are computed from, besides the grading.
struct HydraulicInput {
  /// A stress reduction factor of the fines and where it is from.
  struct Alpha {
    double value = 0;
    std::string origin;
  };
  double porosity = 0;
  double grain_density = 2650;  ///< kg/m³
  micromechanics::SeepageFluid fluid;
  std::vector<Alpha> alphas;
  std::optional<double> top_stress;  ///< Pa, and
  std::optional<double> thickness;   ///< m, of the layer under it

  /// Adds the options for all but porosity and alpha.
  void add_to(CLI::App& command);
};

/// Throws UserError on values that make no sense.
/// The same of all but the porosity.
void check_seepage_options(const HydraulicInput& input, const std::string& who);

void check_hydraulic(const HydraulicInput& input, const std::string& who);

struct HydraulicRow {
  std::string quantity, symbol, unit, source, note;
  double value = 0;
};

/// Critical gradients (Terzaghi; Skempton and Brogan, and Li and Fannin where their input is given),
/// conductivities and the velocity at Terzaghi's gradient, by suffuse/micromechanics/seepage.h.
std::vector<HydraulicRow> hydraulic_rows(const HydraulicInput& input, const micromechanics::Grading& grading);

}  // namespace suffuse::analysis
