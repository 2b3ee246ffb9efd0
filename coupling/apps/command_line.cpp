#include "command_line.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

#include "register_styles.h"
#include "style_table_data.h"
#include "suffuse/common/error.h"
#include "suffuse/common/near_word.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/script_variables.h"

namespace suffuse {

namespace {

namespace files = std::filesystem;

/// How many words follow an option of LIGGGHTS 3.8 (src/lammps.cpp), -1: all up to the next option.
struct Option {
  std::string_view name, shorter;
  int words;
};
constexpr Option kOptions[] = {{"-in", "-i", 1},          {"-var", "-v", -1},
                               {"-log", "-l", 1},         {"-screen", "-sc", 1},
                               {"-echo", "-e", 1},        {"-suffix", "-sf", 1},
                               {"-partition", "-p", -1},  {"-plog", "-pl", 1},
                               {"-pscreen", "-ps", 1},    {"-uid", "-uid", 1},
                               {"-thermo", "-thermo", 1}, {"-seedtolerant", "-st", 0},
                               {"-wb", "-wb", 0},         {"-cuda", "-c", 1},
                               {"-domain", "-domain", 1}, {"-reorder", "-ro", 2},
                               {"-restart", "-r", 2},     {"-restart_offset", "-roff", 3},
                               {"-nocite", "-nc", 0},     {"--help", "-h", 0},
                               {"--version", "-help", 0}, {"--styles", "--styles", 0},
                               {"--words", "--words", 0}};

struct Style {
  std::string kind, name, page, does;
};

std::vector<Style> style_table() {
  std::vector<Style> styles;
  std::istringstream text(kStyleTable);
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line.front() == '#' || line.starts_with("kind\t")) continue;
    std::istringstream cells(line);
    std::vector<std::string> cell;
    for (std::string one; std::getline(cells, one, '\t');) cell.push_back(one);
    if (cell.size() == 5) styles.push_back({cell[0], cell[1], cell[2], cell[4]});
  }
  return styles;
}

/// Where the pages of the reference are: of an installation, or of the sources above this program.
std::string folder_of_pages() {
  std::error_code ignored;
  files::path above = files::read_symlink("/proc/self/exe", ignored).parent_path();
  const files::path installed = above.parent_path() / "share/doc/suffuse/reference";
  if (is_there(installed / "lbm.md")) return installed.string();
  for (; above.has_relative_path(); above = above.parent_path())
    if (is_there(above / "docs/reference/lbm.md")) return (above / "docs/reference").string();
  return "docs/reference";
}

std::string remedy_for(std::string_view option) {
  std::vector<std::string> names;
  for (const Option& known : kOptions) names.emplace_back(known.name);
  const std::string meant = did_you_mean(option, names);
  return meant.empty() ? "see suffuse --help" : meant + " See suffuse --help";
}

bool without_options(int argc, char** argv) {
  return std::none_of(argv + 1, argv + argc, [](const char* word) { return word[0] == '-'; });
}

}  // namespace

std::string styles_text() {
  std::string text = fmt::format("What suffuse adds to LIGGGHTS; pages in {}\n\n", folder_of_pages());
  const std::vector<Style> table = style_table();
  std::vector<std::string> known = registered_styles();
  known.insert(known.begin(), {"command lbm", "command restart_set", "pair_style gran"});
  for (const std::string& name : known) {
    const auto row = std::find_if(table.begin(), table.end(),
                                  [&](const Style& s) { return s.kind + " " + s.name == name; });
    const bool documented = row != table.end();
    text += fmt::format("{:<28} {:<32} {}\n", name, documented ? row->page : "-",
                        documented ? row->does : "of no use by itself: other styles make it");
  }
  return text;
}

void require_known_options(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto option = std::find_if(std::begin(kOptions), std::end(kOptions),
                                     [&](const Option& o) { return o.name == word || o.shorter == word; });
    if (option != std::end(kOptions)) {
      if (option->words >= 0) i += option->words;
      if (word == "-var" || word == "-v") i = std::min(i + 2, argc);  // a value may be negative
      while (option->words < 0 && i + 1 < argc && argv[i + 1][0] != '-') ++i;
      continue;
    }
    if (word.starts_with('-'))
      throw_user_error(
          {"suffuse", "option", std::string(word), "be one of suffuse or LIGGGHTS", remedy_for(word)});
    throw_user_error({"suffuse", "word", std::string(word), "follow an option",
                      fmt::format("write suffuse -in {}, or see suffuse --help", word)});
  }
}

const char* script_name(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i)
    if (std::strcmp(argv[i], "-in") == 0 || std::strcmp(argv[i], "-i") == 0) return argv[i + 1];
  return nullptr;
}

void require_a_readable_script(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "-in") != 0 && std::strcmp(argv[i], "-i") != 0) continue;
    const char* file = i + 1 < argc ? argv[i + 1] : "";
    if (access(file, R_OK) != 0 || is_folder(file))
      throw_user_error(
          {"suffuse", "-in", *file ? file : "nothing", "name a readable script", "check the path"});
    return;
  }
  struct stat input {};
  const bool none = fstat(STDIN_FILENO, &input) != 0 || S_ISCHR(input.st_mode);  // terminal, /dev/null
  if (none)
    throw_user_error(
        {"suffuse", "-in", "nothing", "name a script", "suffuse -in SCRIPT, or see suffuse --help"});
  if (without_options(argc, argv))
    fmt::print(stderr, "suffuse: note: the script is read from standard input; -in SCRIPT names a file\n");
}

void require_known_variables(int argc, char** argv) {
  std::map<std::string, std::string> given;
  for (int i = 1; i + 2 < argc; ++i) {
    if (std::strcmp(argv[i], "-var") != 0 && std::strcmp(argv[i], "-v") != 0) continue;
    const auto [first, is_new] = given.emplace(argv[i + 1], argv[i + 2]);
    if (!is_new && first->second != argv[i + 2])
      fmt::print(stderr, "suffuse: note: -var {} is given twice: {} counts, {} does not\n", first->first,
                 first->second, argv[i + 2]);
    i += 2;
  }
  const char* script = script_name(argc, argv);
  if (script == nullptr || given.empty()) return;
  const ScriptVariables variables(script, "suffuse", given);
  for (const auto& [name, value] : given) variables.require_choice(name, value, "suffuse -var");
  variables.require_no_two_for_one(given, "suffuse -var");
  for (const auto& [name, value] : given) variables.require_known(name, "suffuse -var");
}

}  // namespace suffuse
