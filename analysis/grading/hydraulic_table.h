#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "suffuse/micromechanics/grading.h"
#include "suffuse/micromechanics/seepage.h"

namespace suffuse::analysis {

/// Grains and the water that flows through them, as options of a command.
struct SeepageOptions {
  double grain_density = 2650;  ///< kg/m³
  micromechanics::SeepageFluid fluid;

  /// --grain-density, --fluid-density, --viscosity, --gravity
  void add_to(CLI::App& command);
  /// Throws UserError on values that make no sense.
  void check(const std::string& who) const;
};

/// What gradients and conductivities are computed from, besides the grading.
struct HydraulicInput : SeepageOptions {
  /// A stress reduction factor of the fines and where it is from.
  struct Alpha {
    double value = 0;
    std::string origin;
  };
  double porosity = 0;
  std::vector<Alpha> alphas;
  std::optional<double> top_stress;  ///< Pa, and
  std::optional<double> thickness;   ///< m, of the layer under it

  /// Adds the options for all but porosity and alpha.
  void add_to(CLI::App& command);
};

/// Throws UserError on values that make no sense, of all but the porosity.
void check_seepage_options(const HydraulicInput& input, const std::string& who);

/// The same of the porosity too.
void check_hydraulic(const HydraulicInput& input, const std::string& who);

struct HydraulicRow {
  std::string quantity, symbol, unit, source, note;
  double value = 0;
};

/// Critical gradients (Terzaghi; Skempton and Brogan, and Li and Fannin where their input is given),
/// conductivities and the velocity at Terzaghi's gradient, by suffuse/micromechanics/seepage.h.
std::vector<HydraulicRow> hydraulic_rows(const HydraulicInput& input, const micromechanics::Grading& grading);

}  // namespace suffuse::analysis
