#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suffuse/study/timed_process.h"

namespace suffuse::study {

/// The screen output of a run, in its folder.
inline constexpr const char* kRunLog = "log.txt";

/// What is kept in the folder of a run once it has ended: run.json.
struct RunRecord {
  /// `unsteady`: it ended as it should, but said that its flow was not steady yet where it was to be; its
  /// numbers are those of a state on its way.
  enum class Status { finished, unsteady, failed, too_long };

  Status status = Status::failed;
  std::string reason;  ///< why it did not finish: the program's own last error line; what is not steady
  /// What the run's log says by itself, in its order: notes, warnings (LIGGGHTS's too), effects that changed.
  /// Of lines that differ in their numbers alone the first.
  std::vector<std::string> notes;
  std::string settings;  ///< fingerprint of script, variables and ranks: other settings are another run
  std::string program;   ///< that was run; empty in records of before
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

/// A note without its numbers: those of several runs that say the same have the same one.
std::string kind_of_note(const std::string& note);

/// The last line of a log in which a program of ours tells an error ("suffuse: error: ...", or that of a
/// helper in a script's `shell`), or else LIGGGHTS ("ERROR: ..."), which may only follow from it; without
/// what stands before the message; empty where there is none.
std::string last_error_in(const std::string& log);

}  // namespace suffuse::study
