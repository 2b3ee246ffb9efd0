#pragma once

#include <mpi.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace suffuse {

/// How a file that is there goes on.
struct SeriesContinuation {
  double after = 0;  ///< s; later rows and half a row are cut off
  /// By the run that wrote it: a row of `after` itself stays, and what is there is never put aside.
  bool same_run = false;
};

/// A CSV file of all ranks together: a header of names with units that begins with time_s, and a row a
/// sample, flushed as written. What an earlier run left under the name is put aside (safe_file.h), or gone on
/// with.
class TimeSeriesFile {
 public:
  /// With `continues` the file that is there goes on, if its header is the same. Else it is put aside, or of
  /// the same run a UserError. `who` begins the messages. Collective.
  TimeSeriesFile(const std::string& path, const std::string& header, const std::string& who,
                 std::optional<SeriesContinuation> continues, MPI_Comm communicator);

  /// Time and the values of a row; those of rank 0 count. A disk that does not take it leaves no half row,
  /// and is the same UserError on every rank. Collective.
  void add(const std::vector<double>& values);

  /// Under which name the file of an earlier run is now; empty: there was none, or it goes on. On rank 0.
  const std::string& earlier() const { return earlier_; }

  /// Of the last row that was there and stays, s; before every time where there is none. On every rank.
  double last_time() const { return last_time_; }

 private:
  std::string path_, who_, earlier_;
  MPI_Comm communicator_;
  double last_time_;
  std::ofstream stream_;
};

}  // namespace suffuse
