#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lbm_request.h"
#include "run_effects.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// How long each effect acted in an `lbm run`, and which share of its time it took.
class EffectReport {
 public:
  /// At the beginning of a run.
  void begin(LAMMPS_NS::LAMMPS* lmp, const RunEffects& effects, const CoupledSimulation& simulation);
  /// Before effects are decided again, and at the end: the steps since the last call went by with `effects`.
  void count(const RunEffects& effects, long step);

  /// One row of the report.
  struct Row {
    EffectState state;
    std::optional<double> steps_share;  ///< of this run's fluid steps in which it was on
    std::optional<double> time_share;   ///< of this run's wall time; none where it is not measured by itself
    std::string within;                 ///< then: the row that holds it
  };
  /// `wall`: seconds of the run. Measures what the collision's effects that were on cost (collision_price).
  /// Collective.
  std::vector<Row> rows(LAMMPS_NS::LAMMPS* lmp, const RunEffects& effects, CoupledSimulation& simulation,
                        double wall) const;

 private:
  long first_ = 0, counted_ = 0;
  std::vector<long> steps_on_;  ///< in the order of the effects
  double films_before_ = 0;     ///< s
  long rested_before_ = 0;      ///< steps of the water
};

/// Where the report of a scene belongs: effects.json in the folder of its first monitor or output; empty
/// without either.
std::string effect_report_file(const LbmRequest& settings);

/// Replaces the file. Collective.
void write_effect_report(const std::string& file, const std::vector<EffectReport::Row>& rows,
                         const CoupledSimulation& simulation, double wall, long steps, MPI_Comm communicator);

}  // namespace suffuse::coupling
