#pragma once

#include "../liggghts/liggghts_port.h"
#include "lbm_request.h"
#include "trial_costs.h"

namespace suffuse::coupling {

/// settings_now for the grains as they are; a UserError where the cells of an averaged flow are too small for
/// them. Collective.
CoupledSettings settings_for_grains(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& request,
                                    const LiggghtsPort& port);

/// LIGGGHTS's sub-boxes over the cells of the fluid's box; `low` is set to its low corner.
lbm::Decomposition decomposition_of(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& request,
                                    const LiggghtsPort& port, Vec3& low);

/// DEM steps in a fluid step: as many equal ones as the script's time step, the largest that the contacts
/// allow, needs, or as `substeps` says. A UserError where the two steps cannot work together.
int substeps_for(const LbmRequest& request, const LiggghtsPort& port);

/// What a run of this request would cost, and what it was found with.
struct RunPrice {
  CoupledSettings settings;
  lbm::Index3 cells{};
  TrialCosts costs;
  bool grains_known = false;  ///< their speed is that of this process's last run
  /// Of one second of the flow, core seconds of all ranks.
  double water = 0, grains = 0;
};

/// By a trial with the grains as they are (trial_costs.h). Nothing of the script's state changes. Collective.
RunPrice price_of_run(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& request, LiggghtsPort& port);

}  // namespace suffuse::coupling
