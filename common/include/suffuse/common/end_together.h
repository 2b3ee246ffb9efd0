#pragma once

#include <mpi.h>

#include <string>

namespace suffuse {

/// To be called by a rank that ends with an exit code other than 0: returns when all ranks of the
/// communicator have come here, and ends all of them (MPI_Abort with this code) where some have not within so
/// many seconds, after it has said why. They wait for this one otherwise, for ever: a fault that one rank
/// alone has seen. The communicator is to be one that nothing else is sent on.
void end_together(MPI_Comm communicator, int code, const std::string& why, double seconds = 20);

/// The same where the ranks meet by a collective call that does not block (its request): for a rank that has
/// met a fault in a library in which the others may wait for it.
void end_unless_all_come(MPI_Request& request, int code, const std::string& why, double seconds = 20);

}  // namespace suffuse
