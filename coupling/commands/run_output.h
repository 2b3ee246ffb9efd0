#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "../liggghts/scene.h"
#include "checkpoint_contents.h"
#include "lbm_request.h"
#include "monitor.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/coupling/grain_output.h"
#include "suffuse/coupling/plane_sums.h"

namespace suffuse::coupling {

/// Everything that a run writes at intervals: monitors, fields and grains, restart files. Stays open from one
/// `lbm run` to the next.
class RunOutput {
 public:
  /// Opens what the script has asked for since the last call and drops what it has taken back. With
  /// `took_up_state` new files go on with what an earlier run left in them up to now; what has been written
  /// since this object was made goes on always. Collective.
  void prepare(const LbmRequest& settings, const Scene& scene, const MappedScene& mapped, bool took_up_state);

  /// Is anything due once the fluid has made so many steps?
  bool due(long step) const;
  /// Are values of LIGGGHTS's computes wanted then?
  bool wants_values(long step) const;
  /// Are contacts wanted then?
  bool wants_contacts(long step) const;

  /// Writes what is due now; of new fields and grains their first state, whatever their interval. Collective.
  void write(const Scene& scene);

  /// Saves the state now, within a run, where restart files were asked for; says in which file. The run goes
  /// on as one that takes this state up (restart_instant.h). Collective.
  std::optional<std::string> save(const Scene& scene);

  /// Which states this process has saved or taken up last: its file and step; empty: none.
  std::string last_state() const { return last_state_; }

  /// Quantities that a guard has warned of (run_guards.h); they are saved with a state.
  const std::set<std::string>& warned() const { return warned_; }
  void set_warned(std::set<std::string> warned) { warned_ = std::move(warned); }

  /// The sums over planes that the monitors which are due want, as `write` will use them; null where nothing
  /// is due, or a state is saved before. Collective.
  const PlaneSums* sample_now(long step, CoupledSimulation& simulation);

  /// What samples of all monitors refer to; those saved with a state, for monitors that open from now on.
  MonitorReferences references() const;
  /// What effects have come to (RunEffects::add_to), for the states saved from now on.
  void set_effects(MonitorReferences effects) { effects_ = std::move(effects); }
  void set_references(MonitorReferences references);

 private:
  struct Fields {
    OutputRequest request;
    long every = 1, last_step = -1;
    bool has_first;  ///< in what an earlier run left in the file
    lbm::FieldOutput fluid;
    std::optional<GrainOutput> grains;
  };

  void prepare_monitors(const LbmRequest& settings, const Scene& scene, const MappedScene& mapped,
                        bool took_up_state);
  void prepare_fields(const LbmRequest& settings, const Scene& scene, bool took_up_state);
  std::unique_ptr<Fields> open_fields(const OutputRequest& request, const Scene& scene, bool took_up_state);
  bool was_written(const std::string& file) const;
  bool saves(long step) const;
  static void write_grains(Fields& fields, const Scene& scene);

  std::vector<std::unique_ptr<Monitor>> monitors_;
  MonitorReferences references_, effects_;
  MonitorReferences closed_;  ///< of monitors whose files another line may go on with
  std::vector<std::unique_ptr<Fields>> fields_;
  std::set<std::string> written_;  ///< files of monitors and outputs that were opened, closed ones too
  std::optional<CheckpointRequest> checkpoint_;
  long checkpoint_every_ = 0;
  bool started_ = false;
  std::string last_state_;
  std::set<std::string> warned_;
  std::optional<PlaneSums> sample_;  ///< of the step that is about to be written
};

/// Saves fluid, what monitors refer to, and LIGGGHTS's own restart file as one set (saved_set.h). Collective.
void write_checkpoint(LAMMPS_NS::LAMMPS* lmp, const CoupledSimulation& simulation,
                      const MonitorReferences& references, const std::string& file);

/// Are the grains those of the step in which `file` was saved? Collective.
bool grains_are_of(LAMMPS_NS::LAMMPS* lmp, const std::string& file);

/// A UserError if the grains are not those of the step in which `file` was saved. Collective.
void require_grains_of(LAMMPS_NS::LAMMPS* lmp, const std::string& file);

}  // namespace suffuse::coupling
