#include "suffuse/analysis/study_record.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "suffuse/common/error.h"
#include "suffuse/common/progress.h"
#include "suffuse/common/safe_file.h"

namespace suffuse::analysis {
namespace {

namespace files = std::filesystem;
using Status = RunRecord::Status;

constexpr std::pair<Status, const char*> kNames[] = {{Status::finished, "finished"},
                                                     {Status::unsteady, "unsteady"},
                                                     {Status::failed, "failed"},
                                                     {Status::too_long, "too long"}};
constexpr std::size_t kLongestReason = 400, kLongestNotes = 1000;
constexpr const char* kNoteMark = "note: ";
constexpr const char* kUnsteadyMark = "lbm run: not yet steady";

std::string path_in(const std::string& folder) {
  return (files::path(folder) / "run.json").string();
}

/// What a run that ended as it should says of itself.
void read_notes(RunRecord& record, const std::string& log) {
  std::ifstream stream(log);
  std::set<std::string> known;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(kUnsteadyMark)) {
      record.status = Status::unsteady;
      record.reason = line.substr(std::strlen("lbm run: "));
    }
    const std::size_t at = line.find(kNoteMark);
    if (at == line.npos || (at > 0 && line[at - 1] != ' ')) continue;
    const std::string note = line.substr(at + std::strlen(kNoteMark));
    if (known.insert(note).second) record.notes += (record.notes.empty() ? "" : "; ") + note;
  }
  record.notes = record.notes.substr(0, kLongestNotes);
}

}  // namespace

bool has_results(const RunRecord& record) {
  return record.status == Status::finished || record.status == Status::unsteady;
}

const char* to_string(Status status) {
  for (const auto& [known, name] : kNames)
    if (known == status) return name;
  return "";
}

void write_record(const std::string& folder, const RunRecord& record) {
  SafeFile file(path_in(folder), "suffuse-study");
  file.write(nlohmann::ordered_json{{"status", to_string(record.status)},
                                    {"reason", record.reason},
                                    {"notes", record.notes},
                                    {"wall_s", record.wall},
                                    {"core_s", record.core},
                                    {"other_cores", record.other_cores},
                                    {"settings", record.settings}}
                 .dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
             '\n');
  file.commit();
}

std::optional<RunRecord> read_record(const std::string& folder, const std::string& settings) {
  std::ifstream stream(path_in(folder));
  if (!stream) return std::nullopt;
  try {
    const nlohmann::json json = nlohmann::json::parse(stream);
    RunRecord record;
    record.settings = json.at("settings").get<std::string>();
    if (record.settings != settings) return std::nullopt;
    const std::string name = json.at("status").get<std::string>();
    for (const auto& [status, known] : kNames)
      if (name == known) record.status = status;
    record.reason = json.at("reason").get<std::string>();
    record.wall = json.at("wall_s").get<double>();
    record.core = json.at("core_s").get<double>();
    record.other_cores = json.at("other_cores").get<double>();
    if (json.contains("notes"))
      record.notes = json["notes"].get<std::string>();
    else if (record.status == Status::finished)  // kept before notes were
      read_notes(record, (files::path(folder) / kRunLog).string());
    return record;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // no record of ours: the run is done again
  }
}

std::string last_error_in(const std::string& log) {
  std::ifstream stream(log);
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    for (const char* mark : {"suffuse: error: ", "suffuse: internal error", "ERROR: ", "ERROR on proc "}) {
      const std::size_t at = line.find(mark);
      if (at == line.npos || (at != 0 && std::strncmp(mark, "ERROR", 5) != 0)) continue;
      const bool whole = mark[std::strlen(mark) - 2] != ':';  // the mark is a part of the message
      last = line.substr(whole ? at : at + std::strlen(mark));
      break;
    }
  }
  return last.substr(0, kLongestReason);
}

RunRecord record_of(const ProcessEnd& end, const std::string& log, double limit,
                    const std::string& settings) {
  RunRecord record;
  record.settings = settings;
  record.wall = end.wall;
  record.core = end.core;
  record.other_cores = end.other_cores;
  if (end.how == ProcessEnd::How::too_long) {
    record.status = Status::too_long;
    record.reason = fmt::format("stopped after {}, the study's time_limit", duration_text(limit));
    return record;
  }
  if (end.how == ProcessEnd::How::exited && end.code == 0) {
    record.status = Status::finished;
    read_notes(record, log);
    return record;
  }
  record.reason = last_error_in(log);
  if (record.reason.empty() && end.how == ProcessEnd::How::by_signal)
    record.reason = fmt::format("ended by signal {} ({})", end.code, strsignal(end.code));
  if (record.reason.empty())
    record.reason = fmt::format("ended with code {}; its log.txt says more", end.code);
  return record;
}

}  // namespace suffuse::analysis
