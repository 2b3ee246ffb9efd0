#pragma once

#include <mpi.h>

#include <string>

#include "suffuse/coupling/particle_port.h"

namespace suffuse::coupling {

/// A time series of the grains, in SI, beside the fluid's fields: each snapshot is a group
/// /step_NNNNNNNNNNNN/grains of an HDF5 file with one row a grain, in no certain order: id, radius (m),
/// position (m), velocity (m/s), angular_velocity (rad/s), force (N) and torque (N m) of the fluid. The XDMF
/// file beside it shows the grains as points in ParaView (filter Glyph, sphere, scaled by `diameter`). After
/// each snapshot both files are complete.
class GrainOutput {
 public:
  /// `path` of the HDF5 file; the XDMF file is named like it. With `append` snapshots of an earlier run stay.
  GrainOutput(std::string path, bool append) : path_(std::move(path)), append_(append) {}

  /// Owned grains of all ranks. A snapshot of the same or a later step already in the file is dropped.
  /// Collective.
  void write(long step, double time, const GrainArrays& grains, const GrainMemory& memory,
             MPI_Comm communicator);

 private:
  std::string path_;
  bool append_;
};

}  // namespace suffuse::coupling
