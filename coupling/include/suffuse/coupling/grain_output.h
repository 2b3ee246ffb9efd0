#pragma once

#include <mpi.h>

#include <array>
#include <string>

#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/xdmf_series.h"
#include "suffuse/coupling/particle_port.h"
#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::coupling {

/// What one rank adds to a snapshot of the grains.
struct GrainSnapshot {
  long step = 0;
  double time = 0;     ///< s
  GrainArrays grains;  ///< the owned ones are written
  GrainMemory memory;
  Vec3 box_low = Vec3::Zero(), box_high = Vec3::Zero();  ///< m
  std::array<bool, 3> periodic{};
  const micromechanics::Packing* network = nullptr;  ///< its counted contacts are written, with
                                                     ///< limit and spring; none: no contacts
};

/// A time series of the grains, in SI, beside the fluid's fields: each snapshot is a group
/// /step_NNNNNNNNNNNN of an HDF5 file with the attribute time_s and
///
/// - grains: one row a grain, in no certain order: id, radius (m), position (m), velocity (m/s),
///   angular_velocity (rad/s), force (N) and torque (N m) of the fluid;
/// - box (m): the low and the high corner; periodic: 0 or 1 for x, y, z;
/// - contacts, where there is a network: one row a contact, each once over all ranks and periodic images: ids
///   of both grains; force on the first (N); branch from the second's centre to the first's (m); friction
///   coefficient; friction_limit and spring_force (N), what the contact law caps its tangential spring with
///   and the spring's force, for `suffuse-analyse` to tell which contacts slide; normal_force (N, compression
///   positive); ends (m), the two centres, and lines, their numbers, which the file *_contacts.xdmf shows in
///   ParaView as lines beside the grains (filters Extract Surface and Tube).
///
/// Arrays have an attribute `units`, the root suffuse_version and script.
///
/// That is what `suffuse-analyse contacts` reads (docs/analysis/suffuse-analyse.md). The XDMF file beside it
/// shows the grains as points in ParaView (filter Glyph, sphere, scaled by `diameter`). After each snapshot
/// both files are complete.
class GrainOutput {
 public:
  /// `path` of the HDF5 file; the XDMF file is named like it. With `append` snapshots of an earlier run stay.
  GrainOutput(std::string path, bool append);

  /// A snapshot of the same or a later step already in the file is dropped. All ranks have a
  /// network or none has. Collective.
  void write(const GrainSnapshot& snapshot, MPI_Comm communicator);

 private:
  /// Both XDMF files, of all snapshots that are in the HDF5 file. Collective.
  void show_all(MPI_Comm communicator);

  std::string path_;
  bool append_;
  Hdf5Growth growth_;
  XdmfSeries grains_, contacts_;
  std::string last_;  ///< group; empty before
};

/// The name of the XDMF file of the contacts in an HDF5 file of grains.
std::string contacts_beside(const std::string& path);

}  // namespace suffuse::coupling
