#pragma once

#include "../liggghts/liggghts_port.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// What a run would cost: the one model behind `lbm plan` and the prices of `lbm accuracy`.
struct TrialCosts {
  double fluid = 0, mapping = 0, exchange = 0, samples = 0, grains = 0;  ///< s a fluid step
  double bytes = 0;                                                      ///< of all ranks
  double share = 1;  ///< of the trial's time in which this program had its processors

  double water() const { return fluid + mapping + exchange + samples; }
};

/// Times a few steps of a fluid of these settings and a mapping of the grains as they are, and throws both
/// away. Seconds are those on processors of one's own: without what other programs took from the trial.
/// `dem_step`: the grains' step, settings.substeps of which fill the fluid's; `sweeps`: how often a step
/// monitors and guards go through all cells. What the grains take is left 0. Collective.
TrialCosts trial_costs(const CoupledSettings& settings, const lbm::Decomposition& parts, const Vec3& low,
                       LiggghtsPort& port, double dem_step, double sweeps);

/// What so many steps of LIGGGHTS's take, s: at the speed of its last run, or on usual cores, with the
/// messages between them.
double grain_seconds(int ranks, const PastRun& past, double steps, double grains);

}  // namespace suffuse::coupling
