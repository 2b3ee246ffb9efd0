#pragma once

#include <mpi.h>

#include <functional>
#include <string>
#include <string_view>

namespace suffuse {

/// Does on rank 0 what one rank does for all with files. A failure there is the same UserError on every rank;
/// `who` begins that of a failure of the file system. Collective, and done for all when it returns.
void on_first_rank(const std::string& who, MPI_Comm communicator, const std::function<void()>& work);

/// Gives all ranks the text that rank 0 has. Collective.
void share_text(std::string& text, MPI_Comm communicator);

/// A text file of all ranks together, whole or not there (safe_file.h): rank 0 writes `text`, the others'
/// counts for nothing. Throws the same UserError on every rank where that fails; `who` begins it. Collective,
/// and the file is there for all when it returns.
void write_text(const std::string& path, const std::string& who, std::string_view text,
                MPI_Comm communicator);

}  // namespace suffuse
