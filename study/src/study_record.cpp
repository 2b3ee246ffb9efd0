#include "suffuse/study/study_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "suffuse/common/error.h"
#include "suffuse/common/progress.h"
#include "suffuse/common/safe_file.h"

namespace suffuse::study {
namespace {

namespace files = std::filesystem;
using Status = RunRecord::Status;

constexpr std::pair<Status, const char*> kNames[] = {{Status::finished, "finished"},
                                                     {Status::unsteady, "unsteady"},
                                                     {Status::failed, "failed"},
                                                     {Status::too_long, "too long"}};
constexpr std::size_t kLongestReason = 400, kLongestNote = 400, kMostNotes = 20;
constexpr std::size_t kLongestLine = 2000;  // of a log's line no more is looked at
constexpr const char* kNoteMarks[] = {"note: ", "warning: ", "WARNING: "};
constexpr const char* kUnsteadyMark = "lbm run: not yet steady";

std::string path_in(const std::string& folder) {
  return (files::path(folder) / "run.json").string();
}

/// The next line of a log, or false at its end.
bool next_line(std::ifstream& log, std::string& line) {
  if (!std::getline(log, line)) return false;
  line.resize(std::min(line.size(), kLongestLine));
  return true;
}

/// What a line of a log notes; empty where it is no note.
std::string note_in(const std::string& line) {
  // An effect that has changed: "lbm run: comoving on from 0.31 s: ..."
  static const std::regex changed("lbm run: (\\w+ (on|off) from [-+.e0-9]+ s: .*)");
  if (std::smatch found; std::regex_match(line, found, changed)) return found[1];
  for (const char* mark : kNoteMarks) {
    const std::size_t at = line.find(mark);
    if (at != line.npos && (at == 0 || line[at - 1] == ' ')) return line.substr(at + std::strlen(mark));
  }
  return "";
}

/// What a run says of itself, and whether its flow was steady.
void read_notes(RunRecord& record, const std::string& log) {
  std::ifstream stream(log);
  std::set<std::string> known;
  for (std::string line; next_line(stream, line);) {
    if (line.starts_with(kUnsteadyMark) && record.status == Status::finished) {
      record.status = Status::unsteady;
      record.reason = line.substr(std::strlen("lbm run: "));
    }
    const std::string note = note_in(line).substr(0, kLongestNote);
    if (note.empty() || record.notes.size() == kMostNotes) continue;
    if (known.insert(kind_of_note(note)).second) record.notes.push_back(note);
  }
}

/// Records of before kept one text, or none: the log is read again.
void take_notes(RunRecord& record, const nlohmann::json& json, const std::string& folder) {
  if (json.contains("notes") && json["notes"].is_array())
    record.notes = json["notes"].get<std::vector<std::string>>();
  else
    read_notes(record, (files::path(folder) / kRunLog).string());
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
                                    {"settings", record.settings},
                                    {"program", record.program}}
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
    record.program = json.value("program", "");
    take_notes(record, json, folder);
    return record;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // no record of ours: the run is done again
  }
}

std::string kind_of_note(const std::string& note) {
  static const std::regex number("[-+]?[0-9]+([.][0-9]+)?(e[-+]?[0-9]+)?");
  return std::regex_replace(note, number, "#");
}

std::string last_error_in(const std::string& log) {
  static const std::regex of_ours("suffuse(?:-\\w+)?: (?:error: (.*)|(internal error.*))");
  static const std::regex of_liggghts(".*?(?:ERROR: |(ERROR on proc ))(.*)");
  std::ifstream stream(log);
  std::string ours, liggghts;
  std::smatch found;
  for (std::string line; next_line(stream, line);) {
    if (std::regex_match(line, found, of_ours))
      ours = found[1].str() + found[2].str();
    else if (std::regex_match(line, found, of_liggghts))
      liggghts = found[1].str() + found[2].str();
  }
  return (ours.empty() ? liggghts : ours).substr(0, kLongestReason);
}

RunRecord record_of(const ProcessEnd& end, const std::string& log, double limit,
                    const std::string& settings) {
  RunRecord record;
  record.settings = settings;
  record.wall = end.wall;
  record.core = end.core;
  record.other_cores = end.other_cores;
  if (end.how == ProcessEnd::How::exited && end.code == 0) record.status = Status::finished;
  read_notes(record, log);
  if (has_results(record)) return record;
  if (end.how == ProcessEnd::How::too_long) {
    record.status = Status::too_long;
    record.reason = fmt::format("stopped after {}, the study's time_limit", duration_text(limit));
    return record;
  }
  record.reason = last_error_in(log);
  if (record.reason.empty() && end.how == ProcessEnd::How::by_signal)
    record.reason = fmt::format("ended by signal {} ({})", end.code, strsignal(end.code));
  if (record.reason.empty())
    record.reason = fmt::format("ended with code {}; its log.txt says more", end.code);
  return record;
}

}  // namespace suffuse::study
