#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "suffuse/common/near_word.h"

namespace suffuse {

/// What CLI11 could not parse, as one line that asks for the subcommand or option that was most likely meant.
inline std::string explain(CLI::App& app, const CLI::ParseError& problem) {
  std::string text = problem.what();
  CLI::App* asked = &app;
  while (!asked->get_subcommands().empty()) asked = asked->get_subcommands().front();
  std::vector<std::string> names;
  for (const CLI::App* command : asked->get_subcommands({})) names.push_back(command->get_name());
  for (const CLI::Option* option : asked->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& word : app.remaining(true)) {
    const std::string meant = did_you_mean(word.substr(0, word.find('=')), names);
    if (meant.empty()) continue;
    return word + " is unknown; " + meant + " See --help";
  }
  while (text.ends_with('\n')) text.pop_back();
  return text + "; see --help";
}

}  // namespace suffuse
