#pragma once

#include <mpi.h>

namespace suffuse {

/// To be called by a rank that ends with an exit code other than 0: returns when all ranks of the
/// communicator have come here, and ends all of them (MPI_Abort with this code) where some have not within so
/// many seconds. They wait for this one otherwise, for ever: a fault that one rank alone has seen. The
/// communicator is to be one that nothing else is sent on.
void end_together(MPI_Comm communicator, int code, double seconds = 20);

}  // namespace suffuse
