#pragma once

#include <optional>
#include <string>

#include "suffuse/analysis/timed_process.h"

namespace suffuse::analysis {

/// The screen output of a run, in its folder.
inline constexpr const char* kRunLog = "log.txt";

/// What is kept in the folder of a run once it has ended: run.json.
struct RunRecord {
  /// `unsteady`: it ended as it should, but said that its flow was not steady yet where it was to be; its
  /// numbers are those of a state on its way.
  enum class Status { finished, unsteady, failed, too_long };

  Status status = Status::failed;
  std::string reason;    ///< why it did not finish: the program's own last error line; what is not steady
  std::string notes;     ///< what the program's notes say, each once, joined by "; "
  std::string settings;  ///< fingerprint of script, variables and ranks: other settings are another run
  double wall = 0, core = 0, other_cores = 0;
};

const char* to_string(RunRecord::Status status);

/// Writes run.json, whole or not at all.
void write_record(const std::string& folder, const RunRecord& record);
/// The record of a run that has ended with these settings; nothing where it has not, was interrupted, or had
/// other ones.
std::optional<RunRecord> read_record(const std::string& folder, const std::string& settings);

/// Did it end as it should, so that its numbers can be read?
bool has_results(const RunRecord& record);

/// The record of a run that ended like this; its log says why where it failed, and what it noted.
RunRecord record_of(const ProcessEnd& end, const std::string& log, double limit, const std::string& settings);

/// The last line of a log that tells an error ("suffuse: error: ..." or LIGGGHTS's "ERROR: ..."), without
/// what stands before the message; empty where there is none.
std::string last_error_in(const std::string& log);

}  // namespace suffuse::analysis
