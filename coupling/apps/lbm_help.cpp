#include <fmt/format.h>

#include "../commands/lbm_words.h"
#include "command_line.h"

namespace suffuse {

namespace {

using coupling::CommandFacts;

/// "RHO, kg/m³, > 0, default 1000"
std::string value_text(const WordFacts& word) {
  std::string text = word.value;
  for (const std::string& part : {word.unit, word.range})
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  if (!word.standard.empty()) text += ", default " + word.standard;
  return text;
}

std::string help_of(const CommandFacts& line) {
  std::string text = fmt::format("{}\n{}\n\n", line.form, line.meaning);
  for (const auto* words : {&line.first, &line.words})
    for (const WordFacts& word : *words) {
      text += fmt::format("  {:<20} {}\n", word.word, word.meaning);
      if (const std::string value = value_text(word); !value.empty())
        text += fmt::format("  {:<20} {}\n", "", value);
    }
  if (line.only_before_run) text += "\nOnly before the first `lbm run`, or after `lbm clear`.\n";
  return text;
}

}  // namespace

std::string lbm_help(const std::string& line) {
  if (!line.empty()) return help_of(coupling::lbm_command(line));
  std::string text =
      "Lines of `lbm` in a script (suffuse --help lbm LINE for its words; docs/reference/lbm.md):\n\n";
  for (const CommandFacts& each : coupling::lbm_commands())
    text += fmt::format("  {}\n      {}\n", each.form, each.meaning);
  return text;
}

std::string words_text() {
  std::string text = kWordTitles;
  for (const CommandFacts& line : coupling::lbm_commands()) {
    text += word_row(line.name, "line", {"", line.form, "", "", "", line.meaning});
    for (const WordFacts& word : line.first) text += word_row(line.name, "first", word);
    for (const WordFacts& word : line.words) text += word_row(line.name, "any", word);
  }
  return text;
}

}  // namespace suffuse
