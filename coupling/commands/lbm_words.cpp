#include "lbm_words.h"

#include <algorithm>

#include "lbm_words_of_coupling.h"
#include "lbm_words_of_runs.h"
#include "lbm_words_of_water.h"

namespace suffuse::coupling {

namespace {

/// `lbm monitor ID ...`, `lbm output ID ...`
template <class Request, class Files>
void read_named(const Command<Request>& command, ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp,
                LbmRequest& all, std::vector<Request>& requests, Files files) {
  Request request;
  request.id = reader.word("ID of the " + command.name);
  const auto is_same = [&](const Request& other) { return other.id == request.id; };
  if (reader.accept("off")) {
    read_nothing(reader);
    std::erase_if(requests, is_same);
    return;
  }
  if (std::any_of(requests.begin(), requests.end(), is_same))
    throw_user_error({reader.who(), command.name + " " + request.id, "given twice", "be given once",
                      "drop one of the lines"});
  read_words(command, reader, lmp, request);
  refuse_shared_files(reader, all, files(request));
  requests.push_back(request);
}

/// The lines whose words go into an LbmRequest.
const std::vector<Command<LbmRequest>>& commands_of_requests() {
  static const std::vector<Command<LbmRequest>> lines = [] {
    std::vector<Command<LbmRequest>> all = commands_of_water();
    for (const Command<LbmRequest>& line : commands_of_coupling()) all.push_back(line);
    return all;
  }();
  return lines;
}

}  // namespace

const std::vector<CommandFacts>& lbm_commands() {
  static const std::vector<CommandFacts> all = [] {
    std::vector<CommandFacts> commands;
    for (const auto& command : commands_of_requests()) commands.push_back(facts_of(command));
    for (const CommandFacts& facts : commands_of_runs()) commands.push_back(facts);
    return commands;
  }();
  return all;
}

const CommandFacts& lbm_command(const std::string& name) {
  const std::vector<CommandFacts>& all = lbm_commands();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const CommandFacts& command : all) names.push_back(command.name);
  throw_user_error({"lbm", "word", name.empty() ? "nothing" : name,
                    fmt::format("be one of: {}", fmt::join(names, ", ")), "see suffuse --help lbm"});
}

bool read_request(const std::string& name, ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp,
                  LbmRequest& request) {
  if (name == "monitor") {
    read_named(monitor_command(), reader, lmp, request, request.monitors,
               [](const MonitorRequest& monitor) { return std::vector<std::string>{monitor.file}; });
    return true;
  }
  if (name == "output") {
    read_named(output_command(), reader, lmp, request, request.outputs,
               [](const OutputRequest& output) { return files_of(output); });
    return true;
  }
  for (const auto& command : commands_of_requests())
    if (command.name == name) {
      read_words(command, reader, lmp, request);
      if (command.only_resolved) request.resolved_words.push_back(name);
      return true;
    }
  return false;
}

std::vector<KeptWord> kept_words(const SettingsOfState& state) {
  std::vector<KeptWord> all;
  for (const auto& command : commands_of_requests())
    for (const auto* words : {&command.first, &command.words})
      for (const auto& word : *words) {
        const auto value = word.kept ? word.kept(state) : std::nullopt;
        if (value) all.push_back({command.name, word.facts.word, *value});
      }
  return all;
}

}  // namespace suffuse::coupling
