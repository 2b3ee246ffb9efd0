#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "../liggghts/script_value.h"
#include "monitor_request.h"
#include "run_guards.h"
#include "suffuse/coupling/settings.h"
#include "suffuse/lbm/field_output.h"
#include "wall_limit.h"

namespace suffuse::coupling {

/// One face as the script gives it, SI.
struct ScriptFace {
  lbm::FaceKind kind = lbm::FaceKind::no_slip;
  bool given = false;
  ScriptVector velocity;
  ScriptValue pressure;
};

/// `lbm output`
struct OutputRequest {
  std::string id, file;
  double every = 0;  ///< s
  std::vector<lbm::Field> fields;
  bool grains = false;
  bool contacts = false;  ///< beside the grains, which come with them

  bool operator==(const OutputRequest&) const = default;
};

/// `lbm walls`: which walls of the script let water pass, and which side of the others holds water.
struct WallSettings {
  enum class Water {
    with_grains,  ///< the spaces that grains lie in; all of them without grains
    everywhere,
    at_points,
  };
  std::vector<std::string> open;  ///< IDs of fixes, or of meshes
  Water water = Water::with_grains;
  std::vector<Vec3> points;  ///< m
};

/// `lbm restart write FILE every T`
struct CheckpointRequest {
  std::string file;
  double every = 0;  ///< s
};

/// Everything that `lbm` lines of a script have said so far, as written: `v_NAME` stands for itself, `auto`
/// is open. What it comes to now is CoupledSettings, by settings_now.
struct LbmRequest {
  lbm::UnitsRequest units;
  std::optional<AveragedSettings> averaged;
  bool method_given = false;  ///< `lbm method`: `lbm accuracy` may choose otherwise
  lbm::CollisionSettings collision;
  lbm::Precision precision = lbm::Precision::double_precision;
  SolidSettings solids;
  EffectSettings effects;
  int substeps = 0;  ///< 0: auto
  bool average_force = false;
  std::optional<double> virtual_mass;  ///< else auto
  bool lattice_given = false;
  std::vector<std::string> resolved_words;  ///< lines given that only the resolved flow knows
  std::string region;                       ///< of the fluid; empty: LIGGGHTS's box
  std::array<ScriptFace, lbm::kFaces> faces;
  ScriptVector gravity, pressure_gradient;
  WallSettings walls;
  bool comoving_given = false;  ///< `lbm effect comoving`; else a line `collision` is the last word
  double largest_mach = 0.3;    ///< the run stops above
  std::vector<MonitorRequest> monitors;
  std::vector<OutputRequest> outputs;
  std::optional<CheckpointRequest> checkpoint;
  WallLimit wall_limit;
  GuardLimits guards;
};

/// What the request comes to with the values that variables have now. What `auto` leaves open is still open.
/// Collective.
CoupledSettings settings_now(const LbmRequest& request, LAMMPS_NS::LAMMPS* lmp);

/// Face conditions in lattice units, from the values that variables have now. Faces that no line named are
/// periodic along axes where LIGGGHTS is, and no-slip otherwise. Collective.
lbm::FaceConditions faces_now(const LbmRequest& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp);

/// Every file that an output writes.
std::vector<std::string> files_of(const OutputRequest& output);
/// And every file or folder of a saved state (saved_set.h).
std::vector<std::string> files_of(const CheckpointRequest& checkpoint);

/// A UserError if one of these files belongs to another monitor, output or restart line already.
void refuse_shared_files(const ArgumentReader& reader, const LbmRequest& settings,
                         const std::vector<std::string>& files);

/// What drives fluid and grains, SI. A UserError where velocities would change absurdly in every step: by 100
/// cells a step of gravity, by a tenth of one of a pressure gradient.
Vec3 gravity_now(const LbmRequest& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp);
Vec3 pressure_gradient_now(const LbmRequest& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp);

/// Does any face or force follow a variable?
bool values_change(const LbmRequest& settings);

}  // namespace suffuse::coupling
