#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "suffuse/common/hdf5_file.h"

namespace suffuse {

/// A note beside an HDF5 file that is about to grow, PATH.undo: its length and all bytes that are no values
/// of arrays, or of small ones. HDF5 writes its lists and tables in place, and a file whose writer is killed
/// meanwhile cannot be opened any more; with the note it becomes what it was. For one process; on one rank.

/// `length`: of the file now; 0 where it is to be made anew, and taken back whole. `data`: all arrays in it.
void write_undo(const std::string& path, std::uint64_t length, std::vector<ArrayBytes> data);

/// After the file has been closed.
void drop_undo(const std::string& path);

/// Is there a note?
bool has_undo(const std::string& path);

/// Makes the file what it was, if a writer was killed.
void undo_if_killed(const std::string& path);

}  // namespace suffuse
