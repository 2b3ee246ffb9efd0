#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suffuse/lbm/field_output.h"
#include "suffuse/lbm/fluid.h"
#include "suffuse/lbm/units.h"

namespace suffuse::lbm {

/// One face of a flow case, in SI. The value is reached linearly over `ramp` seconds.
struct FlowFace {
  FaceKind kind = FaceKind::periodic;
  Vec3 velocity_si = Vec3::Zero();
  double pressure_si = 0;
  double ramp = 0;
};

struct FlowSphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

/// A single-phase flow as `suffuse-flow` reads it from a TOML file (docs/lbm/suffuse-flow.md), in SI.
struct FlowCase {
  UnitsRequest units;
  Vec3 size = Vec3::Zero();  ///< of the box, m: a whole number of cells along each axis
  CollisionSettings collision;
  Precision precision = Precision::double_precision;
  std::array<FlowFace, kFaces> faces;

  Vec3 acceleration = Vec3::Zero();       ///< m/s^2
  Vec3 pressure_gradient = Vec3::Zero();  ///< Pa/m along the flow
  double frequency = 0;                   ///< Hz: acceleration and gradient times cos(2 pi f t); 0: constant

  std::vector<FlowSphere> spheres;  ///< fixed, solid; a cell is solid if its centre is inside

  double time = 0;  ///< s to run from the start (or from the state that was read)
  std::optional<double>
      until_steady;  ///< end early when the mean velocity changes by less than this share a tenth

  std::string monitor_file;
  double monitor_every = 0;  ///< s
  std::optional<FieldOutputSettings> output;
  double output_every = 0;  ///< s
  std::string restart_read, restart_write;
};

/// Reads a case. A UserError with the file, the table and the key for unknown words, wrong types, missing or
/// impossible values.
FlowCase read_flow_case(const std::string& path);

/// The number of cells; a UserError that names a spacing that fits if the size is not a whole number of them.
Index3 cells_of(const FlowCase& flow, const Units& units);

/// Face values at a time, in lattice units.
FaceConditions faces_at(const FlowCase& flow, const Units& units, double time_si);

/// Force on a cell at a time, in lattice units.
Vec3 force_at(const FlowCase& flow, const Units& units, double time_si);

}  // namespace suffuse::lbm
