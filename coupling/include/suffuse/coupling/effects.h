#pragma once

#include <string>
#include <vector>

#include "suffuse/coupling/settings.h"

namespace suffuse::coupling {

/// What decides about effects left to `auto`.
struct SceneFacts {
  double fastest_flow = 0;     ///< expected, m/s: given with the lattice, or the fastest of the faces
  double largest_radius = 0;   ///< of the grains, m; 0 without grains
  double largest_density = 0;  ///< of the grains, kg/m^3
  double packing = 0;          ///< grains' volume over that of the smallest box around them
  double gravity = 0;          ///< size of `lbm force gravity`, m/s^2
  bool grains_move = false;
};

/// One line of the manifest.
struct EffectChoice {
  std::string name;
  bool on = false;
  std::string reason;
};

/// Grid Reynolds number u dx/nu from which on `turbulence auto` adds an eddy viscosity: above, eddies between
/// neighbouring cells are neither resolved nor damped.
inline constexpr double kLargestGridReynolds = 10;

/// Stokes number (1/9)(rho_s/rho_f) d u/nu from which on spheres rebound in a liquid as if they were dry
/// (docs key: gondret2002), and solid fraction from which on grains rest on each other rather than move
/// through films (that of the densest suspensions that flow as liquids).
inline constexpr double kDryStokes = 1000, kTouchingPacking = 0.5;

/// Decides every effect of a scene, and says why. The settings' `automatic` switches are replaced by on or
/// off.
std::vector<EffectChoice> choose_effects(EffectSettings& effects, const SceneFacts& facts,
                                         const lbm::Units& units);

/// How long a change of pressure at one end takes to spread through a bed, s: h^2 nu/(pi^2 k c_s^2), the
/// slowest mode of the pressure's diffusion between two open ends. The lattice's fluid is compressible, c_s^2
/// = (dx/dt)^2/3, and stores mass in all cells, those that grains cover included. k is Carman and Kozeny's
/// d^2 n^3/(180 (1-n)^2) (docs key: carman1937). `height` and `diameter` (Sauter) in m.
double pressure_diffusion_time(double height, double porosity, double diameter, const lbm::Units& units);

}  // namespace suffuse::coupling
