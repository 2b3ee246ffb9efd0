#pragma once

#include <string>
#include <utility>
#include <vector>

#include "../liggghts/scene.h"
#include "../liggghts/script_walls.h"
#include "lbm_request.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// Walls of the script made solid for the water, as they are at the start of each `lbm run`
/// (docs/decisions/walls.md).
class WaterWalls {
 public:
  /// Gives the simulation the walls that LIGGGHTS has now, if they are not those that it has already. With a
  /// saved state (its file, or empty) that had the same ones, the same cells lie behind them. True if they
  /// changed. A UserError for walls that cannot be solid for water. Collective.
  bool follow(const Scene& scene, const WallSettings& settings, const std::string& saved_state);

  /// For the manifest: which walls act on the water, which do not and why; nothing without walls.
  const std::vector<std::string>& lines() const { return lines_; }

  /// Planes that act: axis and position (m).
  std::vector<std::pair<int, double>> planes() const;

 private:
  std::string known_;  ///< the walls that the simulation has, as text
  std::vector<std::string> lines_;
  std::vector<ScriptWall> acting_;
  Vec3 origin_ = Vec3::Zero();
  double spacing_ = 0;
};

/// A UserError if grains lie where there is no water: they would move as if dry. Collective.
void refuse_grains_behind_walls(const CoupledSimulation& simulation);

}  // namespace suffuse::coupling
