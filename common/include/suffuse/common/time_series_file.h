#pragma once

#include <mpi.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace suffuse {

/// A CSV file of all ranks together: a header of names with units that begins with time_s, and a row a
/// sample, flushed as written. What an earlier run left under the name is put aside (safe_file.h), or gone on
/// with.
class TimeSeriesFile {
 public:
  /// With `continue_after` (s) the rows that are there and earlier stay, if their header is the same; later
  /// ones and half a row are cut off. `who` begins the messages. Collective.
  TimeSeriesFile(const std::string& path, const std::string& header, const std::string& who,
                 std::optional<double> continue_after, MPI_Comm communicator);

  /// Time and the values of a row; those of rank 0 count. A disk that does not take it leaves no half row,
  /// and is the same UserError on every rank. Collective.
  void add(const std::vector<double>& values);

  /// Under which name the file of an earlier run is now; empty: there was none, or it goes on. On rank 0.
  const std::string& earlier() const { return earlier_; }

 private:
  std::string path_, who_, earlier_;
  MPI_Comm communicator_;
  std::ofstream stream_;
};

}  // namespace suffuse
