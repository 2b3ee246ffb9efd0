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

/// Everything that `lbm` lines of a script have said so far.
struct LbmSettings {
  CoupledSettings coupled;
  bool fluid_given = false, lattice_given = false;
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

/// Reads the words after `lbm fluid`, `lbm lattice`, ... into the settings. Each throws a UserError for words
/// that it does not know and values that cannot work, and leaves the settings as they were.
/// docs/reference/lbm.md lists the words.
/// `lbm method resolved | averaged [drag LAW] [graded yes|no]`
void read_method(ArgumentReader& reader, LbmSettings& settings);
void read_preset(ArgumentReader& reader, LbmSettings& settings);
void read_fluid(ArgumentReader& reader, LbmSettings& settings);
void read_lattice(ArgumentReader& reader, LbmSettings& settings);
void read_boundary(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, LbmSettings& settings);
void read_force(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, LbmSettings& settings);
void read_collision(ArgumentReader& reader, LbmSettings& settings);
void read_solid(ArgumentReader& reader, LbmSettings& settings);
void read_walls(ArgumentReader& reader, LbmSettings& settings);
void read_effect(ArgumentReader& reader, LbmSettings& settings);
void read_couple(ArgumentReader& reader, LbmSettings& settings);
void read_guard(ArgumentReader& reader, LbmSettings& settings);
void read_monitor(ArgumentReader& reader, LbmSettings& settings);
void read_output(ArgumentReader& reader, LbmSettings& settings);

/// Face conditions in lattice units, from the values that variables have now. Faces that no line named are
/// periodic along axes where LIGGGHTS is, and no-slip otherwise. Collective.
lbm::FaceConditions faces_now(const LbmSettings& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp);

/// Every file that an output writes.
std::vector<std::string> files_of(const OutputRequest& output);
/// And every file or folder of a saved state (saved_set.h).
std::vector<std::string> files_of(const CheckpointRequest& checkpoint);

/// A UserError if one of these files belongs to another monitor, output or restart line already.
void refuse_shared_files(const ArgumentReader& reader, const LbmSettings& settings,
                         const std::vector<std::string>& files);

/// What drives fluid and grains, SI. A UserError where velocities would change absurdly in every step: by 100
/// cells a step of gravity, by a tenth of one of a pressure gradient.
Vec3 gravity_now(const LbmSettings& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp);
Vec3 pressure_gradient_now(const LbmSettings& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp);

/// Does any face or force follow a variable?
bool values_change(const LbmSettings& settings);

}  // namespace suffuse::coupling
