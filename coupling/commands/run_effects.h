#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "../liggghts/film_forces.h"
#include "../liggghts/scene.h"
#include "checkpoint_contents.h"
#include "lbm_request.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/coupling/effects.h"

namespace suffuse::coupling {

/// Fastest flow that the script expects, m/s: given with the lattice, or at faces as they are now.
double given_speed(const lbm::UnitsRequest& request, const lbm::FaceConditions& faces);

/// What effects are decided by, but for the speeds of the water. `settings`: with faces and forces of now.
/// Collective.
EffectFacts facts_of_grains(const CoupledSettings& settings, const LiggghtsPort& port,
                            LAMMPS_NS::LAMMPS* lmp);

/// Of the grains whose centre lies in the water's box, m/s: others are dry. Collective.
double fastest_wet_grain(const LiggghtsPort& port, const CoupledSimulation& simulation);

/// The effects of a scene while it runs: decided at its start, at the beginning of each `lbm run` and at
/// steps that are multiples of kEffectsEvery, and what acts on them.
///
/// These steps are the fluid's own numbers, whatever else is looked at or written: a run that a saved state
/// continues decides the same.
class RunEffects {
 public:
  static constexpr long kEffectsEvery = 250;

  /// Before there is a simulation; `state`: the saved one that is taken up, or empty. What the effects of
  /// `settings`, whose faces and forces are those of now, come to. Collective.
  EffectSettings start(const CoupledSettings& settings, const LiggghtsPort& port, LAMMPS_NS::LAMMPS* lmp,
                       const std::string& state);

  /// At the beginning of an `lbm run`, before LIGGGHTS is set up. Returns lines about what has changed.
  /// Collective.
  std::vector<std::string> begin(const Scene& scene, const FilmForces::Water& water);

  /// Within a run, after so many fluid steps. Collective.
  std::vector<std::string> check(const Scene& scene, const lbm::FluidExtremes& extremes);

  const std::vector<EffectState>& states() const { return switches_->states(); }
  const EffectState& state(const std::string& name) const { return switches_->state(name); }
  /// For saved states, among the monitors' references.
  void add_to(MonitorReferences& references) const;
  void withdraw(LAMMPS_NS::LAMMPS* lmp) { films_.withdraw(lmp); }
  /// That films have taken in this process, on this rank.
  double film_seconds(LAMMPS_NS::LAMMPS* lmp) const { return films_.seconds(lmp); }

 private:
  EffectFacts facts_now(const Scene& scene, double water_speed) const;

  std::optional<EffectSwitches> switches_;
  FilmForces films_;
  FilmForces::Water water_;
  bool restored_ = false;  ///< from a saved state, and not begun yet
  long looked_at_ =
      -1;  ///< step: faces that follow variables have other values at the same step of a new run
};

}  // namespace suffuse::coupling
