#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace suffuse {

/// An XDMF file that shows the states of a growing HDF5 file one after the other: a collection of grids.
class XdmfSeries {
 public:
  /// `name`: of the collection.
  XdmfSeries(std::string path, std::string name) : path_(std::move(path)), name_(std::move(name)) {}

  /// The file with these <Grid> elements, and no others; whole or not there (safe_file.h). What rank 0 has
  /// counts. Collective; a UserError on all ranks where the disk does not take it.
  void write(std::string_view grids, MPI_Comm communicator);

  /// Puts <Grid> elements after the last, with write()'s care. False, and nothing is done, where the file is
  /// not as this object left it, or where the addition before has failed.
  bool add(std::string_view grids, MPI_Comm communicator);

 private:
  std::string path_, name_;
  std::uint64_t length_ = 0;  ///< of the file as it was left, on rank 0; 0 before
};

}  // namespace suffuse
