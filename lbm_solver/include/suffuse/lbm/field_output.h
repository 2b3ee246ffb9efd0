#pragma once

#include <functional>
#include <string>
#include <vector>

#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/xdmf_series.h"
#include "suffuse/lbm/fluid.h"
#include "suffuse/lbm/units.h"

namespace suffuse::lbm {

enum class Field { velocity, pressure, density, solid_fraction };

struct FieldFacts {
  Field field;
  const char* word;  ///< in scripts and files
  const char* unit;
  std::size_t components;
};

/// Every field, in the order of the enumeration.
inline constexpr FieldFacts kFields[] = {{Field::velocity, "velocity", "m/s", 3},
                                         {Field::pressure, "pressure", "Pa", 1},
                                         {Field::density, "density", "kg/m3", 1},
                                         {Field::solid_fraction, "solid_fraction", "1", 1}};

constexpr const FieldFacts& facts_of(Field field) {
  return kFields[static_cast<int>(field)];
}

struct FieldOutputSettings {
  std::string path;  ///< of the HDF5 file; the XDMF file beside it is named like it, with .xdmf
  std::vector<Field> fields{Field::velocity, Field::pressure};
  Vec3 origin = Vec3::Zero();  ///< of the box, m
  bool append = false;         ///< keep the snapshots that are in the file and earlier than the next one

  /// Solid fraction of a cell of this rank, 0 to 1; without it, whole solid cells count.
  std::function<double(const Index3& cell)> solid_fraction;
  /// Velocity and density of the cells of this rank; without it, the fluid's own (Fluid::for_each_point).
  std::function<void(const Fluid::PointVisitor& visit)> for_each_point;
};

/// The name of the XDMF file of an HDF5 file.
std::string xdmf_beside(const std::string& path);

/// A time series of fields on the cells, in SI: velocity (m/s), pressure (Pa above the reference), density
/// (kg/m^3), solid fraction (-). Each snapshot is a group /step_NNNNNNNNNNNN of the HDF5 file, written by all
/// ranks together in float, each array with an attribute `units`; the root has origin_x_m, origin_y_m,
/// origin_z_m (low corner of the first cell), spacing_m, suffuse_version and script. ParaView opens the XDMF
/// file. After each snapshot both files are complete: a run that is killed loses none.
class FieldOutput {
 public:
  FieldOutput(const FieldOutputSettings& settings, const Units& units);

  /// Collective. A snapshot of the same or a later step already in the file (an earlier run's) is replaced or
  /// dropped.
  void write(const Fluid& fluid);

 private:
  FieldOutputSettings settings_;
  Units units_;
  Hdf5Growth growth_;
  XdmfSeries series_;
  std::string last_;  ///< group; empty before
};

}  // namespace suffuse::lbm
