#pragma once

#include <map>
#include <string>
#include <vector>

#include "suffuse/coupling/effect_switch.h"
#include "suffuse/coupling/settings.h"

namespace suffuse::coupling {

/// What decides about effects left to `auto`. The same on all ranks.
struct EffectFacts {
  double given_speed = 0;      ///< fastest flow that the script expects, m/s: with the lattice, or at a face
  double water_speed = 0;      ///< fastest water that a look has seen, m/s
  double grain_speed = 0;      ///< fastest grain in the water that a look has seen, m/s
  double largest_radius = 0;   ///< of the grains, m; 0 without grains
  double largest_density = 0;  ///< of the grains, kg/m^3
  double packing = 0;          ///< grains' volume over that of the smallest box around them
  double gravity = 0;          ///< size of `lbm force gravity`, m/s^2
  double virtual_mass = 0;     ///< largest virtual_mass_number of the grains
  bool grains_move = false;
  std::string films_of_script;  ///< ID of its own `fix lubrication`; empty: none
};

/// Grid Reynolds number u dx/nu from which on `turbulence auto` adds an eddy viscosity: above, eddies between
/// neighbouring cells are neither resolved nor damped. Measured (docs/results/effects.md): up to 30 it takes
/// less than 3 % of the energy of grains thrown through water, a fifth of what a lattice twice as fine
/// changes; from 150 on the flow is lost without it.
inline constexpr Hysteresis kGridReynolds{30, 15};

/// Speed of grains in viscosities a cell, V dx/nu, from which on the drag of a bed that carries its water is
/// 2 % too large with `trt` (docs/decisions/solid-operator.md).
inline constexpr Hysteresis kFastGrains{3, 1.5};

/// Stokes number (1/9)(rho_s/rho_f) d u/nu from which on spheres rebound in a liquid as if they were dry
/// (docs key: gondret2002), and solid fraction from which on grains rest on each other rather than move
/// through films (that of the densest suspensions that flow as liquids).
inline constexpr Hysteresis kDryStokes{1000, 500}, kTouchingPacking{0.5, 0.45};

/// Largest speed, cells a step, at which a uniform stream is linearly stable with `trt_comoving` along an
/// axis, and packings that are carried along (1, 1, 1) gain no energy (docs/decisions/solid-operator.md).
double largest_comoving_speed(double relaxation_time);

/// The effects of a scene: what the script asked for, what it came to, and why. Free of LIGGGHTS and MPI: the
/// same facts give the same decisions.
class EffectSwitches {
 public:
  EffectSwitches(const CoupledSettings& asked, const lbm::Units& units);

  /// At the beginning of an `lbm run`: what follows from the script alone, and the flow's effects if these
  /// were never decided or grains begin or cease to move. `time` as in `check`.
  std::vector<std::string> begin(const EffectFacts& facts, double time);

  /// Decides all of them; returns one line for each that changed. `time` of the water, s.
  std::vector<std::string> check(const EffectFacts& facts, double time);

  const std::vector<EffectState>& states() const { return states_; }
  const EffectState& state(const std::string& name) const;
  /// On or off, as decided.
  EffectSettings settings() const;

  /// What a saved state keeps of each, by name.
  std::map<std::string, std::vector<double>> record() const;
  /// Effects that the record does not know are decided at the next `begin`. A UserError where it is no such
  /// record.
  void restore(const std::map<std::string, std::vector<double>>& record, const std::string& who);

 private:
  EffectState& at(const std::string& name);
  void decide_scene(const EffectFacts& facts);
  void decide_flow(const EffectFacts& facts);
  void turbulence(const EffectFacts& facts);
  void comoving(const EffectFacts& facts);
  void lubrication(const EffectFacts& facts);
  std::vector<std::string> changed_since(const std::vector<EffectState>& before, double time);

  lbm::Units units_;
  bool averaged_;
  lbm::CollisionOperator operator_;
  std::optional<double> virtual_mass_;
  double smagorinsky_;
  std::vector<EffectState> states_;
  std::string films_of_script_;  ///< at the last decision
  bool decided_ = false;
};

/// How long a change of pressure at one end takes to spread through a bed, s: h^2 nu/(pi^2 k c_s^2), the
/// slowest mode of the pressure's diffusion between two open ends. The lattice's fluid is compressible, c_s^2
/// = (dx/dt)^2/3, and stores mass in all cells, those that grains cover included. k is Carman and Kozeny's
/// d^2 n^3/(180 (1-n)^2) (docs key: carman1937). `height` and `diameter` (Sauter) in m.
double pressure_diffusion_time(double height, double porosity, double diameter, const lbm::Units& units);

}  // namespace suffuse::coupling
