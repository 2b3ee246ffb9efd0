#pragma once

#include <mpi.h>

#include <string>
#include <string_view>

namespace suffuse {

/// A text file of all ranks together, whole or not there (safe_file.h): rank 0 writes `text`, the others'
/// counts for nothing. Throws the same UserError on every rank where that fails; `who` begins it. Collective,
/// and the file is there for all when it returns.
void write_text(const std::string& path, const std::string& who, std::string_view text,
                MPI_Comm communicator);

}  // namespace suffuse
