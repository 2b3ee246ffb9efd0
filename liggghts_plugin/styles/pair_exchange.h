#pragma once

#include <mpi.h>

#include <vector>

#include "suffuse/micromechanics/broken_contacts.h"

namespace suffuse {

/// Sends every pair to the rank that a hash of it names, so that equal pairs of different times meet.
/// Collective; result sorted.
std::vector<micromechanics::GrainPair> share_out_by_hash(const std::vector<micromechanics::GrainPair>& pairs,
                                                         MPI_Comm communicator);

/// All pairs of all ranks, sorted, on rank 0; empty on the others. Collective.
std::vector<micromechanics::GrainPair> gather_pairs(const std::vector<micromechanics::GrainPair>& pairs,
                                                    MPI_Comm communicator);

}  // namespace suffuse
