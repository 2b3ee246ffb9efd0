#pragma once

#include <optional>

#include "../liggghts/liggghts_port.h"
#include "lbm_settings.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

struct RunRequest {
  double time = 0;               ///< s
  std::optional<double> steady;  ///< end early when the flow changes by less than this share
};

/// One `lbm run`: what is due at which fluid step.
class LbmRun {
 public:
  LbmRun(LAMMPS_NS::LAMMPS* lmp, const LbmSettings& settings, LiggghtsPort& port,
         CoupledSimulation& simulation);

  /// Prints the manifest, runs, prints where the time went. Collective.
  void run(const RunRequest& request);

 private:
  void set_values();

  LAMMPS_NS::LAMMPS* lmp_;
  const LbmSettings& settings_;
  LiggghtsPort& port_;
  CoupledSimulation& simulation_;
  bool speaks_;
};

}  // namespace suffuse::coupling
