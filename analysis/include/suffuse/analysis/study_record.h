#pragma once

#include <optional>
#include <string>

#include "suffuse/analysis/timed_process.h"

namespace suffuse::analysis {

/// What is kept in the folder of a run once it has ended: run.json.
struct RunRecord {
  enum class Status { finished, failed, too_long };

  Status status = Status::failed;
  std::string reason;    ///< why it did not finish: the program's own last error line
  std::string settings;  ///< fingerprint of script, variables and ranks: other settings are another run
  double wall = 0, core = 0, other_cores = 0;
};

const char* to_string(RunRecord::Status status);

/// Writes run.json, whole or not at all.
void write_record(const std::string& folder, const RunRecord& record);
/// The record of a run that has ended with these settings; nothing where it has not, was interrupted, or had
/// other ones.
std::optional<RunRecord> read_record(const std::string& folder, const std::string& settings);

/// The record of a run that ended like this; its log says why where it failed.
RunRecord record_of(const ProcessEnd& end, const std::string& log, double limit, const std::string& settings);

/// The last line of a log that tells an error ("suffuse: error: ..." or LIGGGHTS's "ERROR: ..."), without
/// what stands before the message; empty where there is none.
std::string last_error_in(const std::string& log);

}  // namespace suffuse::analysis
