#pragma once

#include <CLI/App.hpp>
#include <string>

#include "suffuse/micromechanics/seepage.h"
#include "verdict/result_rows.h"

namespace suffuse::analysis {

/// `suffuse-analyse fluidisation FLOW.csv`: porosity, conductivity and critical gradients of an upward-flow
/// run from its monitor file, beside what formulas say.
void add_fluidisation(CLI::App& app);

/// What it finds without further options. `grading`: a file, for the formulas of conductivity; may be empty.
/// Densities in kg/m³.
ResultRows fluidisation_rows(const std::string& flow, const std::string& grading, double grain_density,
                             const micromechanics::SeepageFluid& fluid);

}  // namespace suffuse::analysis
