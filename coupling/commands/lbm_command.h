#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../liggghts/scene.h"
#include "lbm_words.h"
#include "run_effects.h"
#include "run_output.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "water_walls.h"

namespace suffuse::coupling {

/// The `lbm` command of one LIGGGHTS instance (docs/reference/lbm.md): keeps what its lines have said, builds
/// the fluid when the first one needs it, and runs it.
class LbmCommand {
 public:
  /// Makes the word `lbm` known to a LIGGGHTS instance.
  static void add_to(LAMMPS_NS::LAMMPS* lmp);
  /// Ends the fluid of an instance; before LIGGGHTS is closed.
  static void remove_from(LAMMPS_NS::LAMMPS* lmp);

  explicit LbmCommand(LAMMPS_NS::LAMMPS* lmp) : lmp_(lmp) {}

  /// One line: the words after `lbm`.
  void line(int narg, char** arg);

 private:
  void clear();
  void restart(ArgumentReader& reader);
  void accuracy(ArgumentReader& reader);
  void choose_lattice(const AccuracyRequest& request);
  void plan(ArgumentReader& reader);
  void run(ArgumentReader& reader);
  void run_scene(const ArgumentReader& reader, const RunLine& asked);
  void refuse_after_start(const std::string& word) const;
  void require_lattice(const std::string& who) const;
  void forget_the_port();
  void build();
  void read_state();
  void warn_about_held_grains();
  int choose_substeps();
  Scene scene() { return {lmp_, *port_, *simulation_}; }

  LAMMPS_NS::LAMMPS* lmp_;
  LbmRequest request_;
  std::unique_ptr<LiggghtsPort> port_;
  std::unique_ptr<CoupledSimulation> simulation_;
  RunEffects effects_;
  WaterWalls walls_;
  RunOutput output_;
  std::string state_to_read_;
  bool took_up_state_ = false;  ///< of `lbm restart read`
  bool warned_about_held_grains_ = false;
};

}  // namespace suffuse::coupling
