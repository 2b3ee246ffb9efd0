#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>

namespace suffuse::coupling {

/// States of water and grains of the same step, under one name: FILE is a link to the last, a folder FILE.1
/// or FILE.2 with `fluid.h5` (unless the scene is dry), LIGGGHTS's `grains`, and `set`, which says what a
/// whole set is. The folder before it stays. A new one is written as FILE.new and takes its place when it is
/// whole and on the disk; then one renaming of the link makes it the last. FILE.grains is a link to
/// FILE/grains.

/// `who` begins the messages of what follows.

/// A UserError if FILE is not free and is no such link, or cannot be made. Collective.
void require_free_for_sets(const std::string& file, const std::string& who, MPI_Comm communicator);

/// Where fluid and grains of the next set are to be written. Collective; a UserError as above.
struct NewSet {
  std::string fluid, grains;
};
NewSet begin_set(const std::string& file, const std::string& who, MPI_Comm communicator);

/// They are written, or the grains alone in a dry scene: makes them the last. A UserError where the disk does
/// not take them, and FILE is what it was before. Collective.
void finish_set(const std::string& file, const std::string& who, MPI_Comm communicator);

/// The fluid's file of a state: of a set, which must be whole (a UserError otherwise), or the file itself. On
/// one rank.
std::string fluid_of_set(const std::string& file);

/// A UserError if a restart file of LIGGGHTS is not what was written: that of a set by its size and sum,
/// others if they end too early. LIGGGHTS itself waits for ever for what is missing. On one rank.
void require_whole_restart_file(const std::string& file);

/// The bytes of `from`, an open file, to a file `path`, on the disk when this returns. A UserError where it
/// does not take them.
void write_checked(int from, const std::string& path, const std::string& who);

}  // namespace suffuse::coupling
