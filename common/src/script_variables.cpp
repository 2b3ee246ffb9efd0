#include "suffuse/common/script_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "suffuse/common/checksum.h"
#include "suffuse/common/error.h"
#include "suffuse/common/near_word.h"
#include "suffuse/common/paths.h"

namespace suffuse {
namespace {

namespace files = std::filesystem;

/// Styles that leave a variable alone that is there already, as -var makes it.
constexpr const char* kKept[] = {"index", "loop", "world", "universe", "uloop"};

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

void add(std::vector<std::string>& list, const std::string& text) {
  if (!contains(list, text)) list.push_back(text);
}

/// What a script has instead of a name that it has not; the one that was meant first.
std::string known_for(const std::string& name, const std::vector<std::string>& settable) {
  const std::string meant = did_you_mean(name, settable);
  return fmt::format("{}{}it has {}", meant, meant.empty() ? "" : " ",
                     settable.empty() ? "none" : fmt::format("{}", fmt::join(settable, ", ")));
}

/// Does a script's text use or set the variable?
bool uses(const std::string& text, const std::string& name) {
  if (!std::regex_match(name, std::regex("\\w+"))) return false;
  return text.find("${" + name + "}") != text.npos ||
         (name.size() == 1 && text.find('$' + name) != text.npos) ||
         std::regex_search(text, std::regex("\\b(v_|variable\\s+|next\\s+)" + name + "\\b"));
}

std::string path_of(const std::string& file) {
  return files::path(file).lexically_normal().string();
}

/// A file's name with variables in it as a pattern: each stands for any text.
std::regex pattern_of(const std::string& name) {
  static const std::regex variable(R"(\$\{[^}]*\}|\$[A-Za-z])");
  std::string pattern;
  std::sregex_token_iterator part(name.begin(), name.end(), variable, -1), end;
  for (bool first = true; part != end; ++part, first = false) {
    if (!first) pattern += ".*";
    for (const char c : part->str())
      pattern += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : std::string("\\") + c;
  }
  if (name.ends_with('}')) pattern += ".*";
  return std::regex(pattern);
}

}  // namespace

std::string fingerprint_of(const std::string& text) {
  return fmt::format("{:016x}", checksum_of(text));
}

ScriptVariables::ScriptVariables(const std::string& script, const std::string& who,
                                 const std::map<std::string, std::string>& given)
    : script_(script), folder_(files::path(script).parent_path().string()), values_(given), certain_(given) {
  values_.insert_or_assign("script_folder", folder_.empty() ? "." : folder_);
  for (const auto& [name, value] : given) offered_[name] = {value};
  read(script, {});
  if (texts_.empty())
    throw_user_error({who, "script", script, "be readable", "check the path and the permissions"});
  note_head();
}

void ScriptVariables::read(const std::string& file, const Choices& under) {
  const std::string path = path_of(file);
  std::vector<Choices>& ways = ways_[path];
  const auto leads_here = [&](const Choices& way) {
    return std::includes(under.begin(), under.end(), way.begin(), way.end());
  };
  if (std::any_of(ways.begin(), ways.end(), leads_here)) return;
  ways.push_back(under);
  if (!texts_.contains(path)) {
    std::ifstream stream(path);
    if (!stream) return;
    text_ += texts_[path] = std::string{std::istreambuf_iterator<char>(stream), {}} + '\n';
  }
  const std::string& text = texts_[path];  // stays while others are read
  static const std::regex other_file(R"(\b(?:include|jump)\s+["']?([^\s"']+))");  // in `if ... then` too
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    note_definition(line.substr(0, line.find('#')));
    for (std::sregex_iterator found(line.begin(), line.end(), other_file), end; found != end; ++found)
      if ((*found)[1] != "SELF") include((*found)[1], line.starts_with("include"), under);
  }
}

/// Values that hold wherever the script branches later: definitions at its head, of one plain word.
void ScriptVariables::note_head() {
  static const std::regex definition(R"(\s*variable\s+(\w+)\s+(\w+)\s+(.*?)\s*)"), word(R"([^\s$"'&]+)");
  std::vector<std::string> seen;
  std::istringstream lines(texts_[path_of(script_)]);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    std::smatch found;
    if (!std::regex_match(line, found, definition)) {
      if (line.find_first_not_of(" \t\r") != line.npos) break;
      continue;
    }
    const std::string value = found[3];
    if (!contains(seen, found[1]) && found[2] == "index" && std::regex_match(value, word))
      certain_.emplace(found[1], value);
    add(seen, found[1]);
  }
  std::erase_if(certain_,
                [&](const auto& one) { return !choices_.contains(one.first) || changes(one.first); });
}

/// Does some line take the variable to its next value, or away?
bool ScriptVariables::changes(const std::string& name) const {
  return std::regex_search(
      text_, std::regex("\\bnext\\s[^\n]*\\b" + name + "\\b|\\bvariable\\s+" + name + "\\s+delete\\b"));
}

void ScriptVariables::note_definition(const std::string& line) {
  static const std::regex definition(R"(\bvariable\s+(\w+)\s+(\w+)(?:\s+([^\s"']+))?)");
  std::smatch found;
  if (!std::regex_search(line, found, definition)) return;
  const bool kept = std::find(std::begin(kKept), std::end(kKept), found[2].str()) != std::end(kKept);
  if (kept && found[3].matched) values_.emplace(found[1], found[3]);
  if (kept && !certain_.contains(found[1])) {
    std::string values = line.substr(static_cast<std::size_t>(found.position(2) + found.length(2)));
    std::erase_if(values, [](char c) { return c == '"' || c == '\''; });
    std::istringstream words(values);
    for (std::string word; words >> word;) add(offered_[found[1]], word);
  }
  if (kept || found[2] != "delete") add(kept ? settable_ : set_by_script_, found[1]);
}

void ScriptVariables::include(const std::string& words, bool always, const Choices& under) {
  // A variable alone is a file's whole name with its folder.
  static const std::regex alone(R"(\$\{(\w+)\})");
  if (std::regex_match(words, alone)) {
    const std::vector<std::string> names = offered_[words.substr(2, words.size() - 3)];
    if (names.empty()) all_found_ = false;
    for (const std::string& name : names) {
      if (name == "&" || std::regex_match(name, alone))
        all_found_ = false;
      else
        include(name, false, under);
    }
    return;
  }
  const files::path path(words);
  const files::path folder = folder_of(path.parent_path().string());
  if (folder.string().find('$') != std::string::npos) all_found_ = false;
  if (!is_folder(folder)) return;  // made during the run
  std::vector<std::string> fitting;
  const std::regex pattern = pattern_of(path.filename().string());
  for (const auto& entry : files::directory_iterator(folder))
    if (entry.is_regular_file() && std::regex_match(entry.path().filename().string(), pattern))
      fitting.push_back(entry.path().string());
  std::sort(fitting.begin(), fitting.end());
  // A file's name with one variable in it offers what stands in its place in the names of the files there.
  static const std::regex one_variable(R"(([^$]*)\$\{(\w+)\}([^$]*))");
  const std::string name = path.filename().string();
  std::smatch found;
  const bool offers =
      always && words.starts_with("${script_folder}") && std::regex_match(name, found, one_variable);
  if (offers) included_as_.emplace(found[2], name);
  for (const std::string& file : fitting) {
    Choices choices = under;
    if (offers) {
      const std::string there = files::path(file).filename().string();
      const auto before = static_cast<std::size_t>(found[1].length());
      const std::string value =
          there.substr(before, there.size() - before - static_cast<std::size_t>(found[3].length()));
      add(choices_[found[2]], value);
      choices.emplace(found[2], value);
    }
    read(file, choices);
  }
}

std::string ScriptVariables::folder_of(const std::string& name) const {
  std::string folder = name.empty() ? "." : name;
  for (const auto& [variable, value] : values_) {
    const std::string word = "${" + variable + "}";
    for (std::size_t at = folder.find(word); at != folder.npos; at = folder.find(word, at + value.size()))
      folder.replace(at, word.size(), value);
  }
  return folder;
}

/// What of these choices -var would have to say, as `-var NAME VALUE`.
std::vector<std::string> ScriptVariables::unmet(const Choices& choices) const {
  std::vector<std::string> words;
  for (const auto& [name, value] : choices)
    if (const auto own = certain_.find(name); own != certain_.end() && own->second != value)
      words.push_back(fmt::format("-var {} {}", name, value));
  return words;
}

/// As `-var NAME VALUE`; the first is empty if the script reads the name as it is called.
std::vector<std::string> ScriptVariables::choices_that_read(const std::string& name) const {
  std::vector<std::string> choices;
  for (const auto& [path, text] : texts_) {
    if (!uses(text, name)) continue;
    for (const Choices& way : ways_.at(path)) {
      const std::vector<std::string> words = unmet(way);
      if (words.empty()) return {""};
      add(choices, fmt::format("{}", fmt::join(words, " ")));
    }
  }
  return choices;
}

bool ScriptVariables::reads(const std::string& name) const {
  if (!all_found_) return true;
  const std::vector<std::string> choices = choices_that_read(name);
  return !choices.empty() && choices.front().empty();
}

void ScriptVariables::require_known(const std::string& name, const std::string& who) const {
  if (reads(name)) return;
  const std::string script = files::path(script_).filename().string();
  const std::vector<std::string> choices = choices_that_read(name);
  if (choices.empty())
    throw_user_error({who, "variable", name, "be used by " + script + " or a file that it includes",
                      known_for(name, settable_)});
  throw_user_error({who, "variable", name, "be used by " + script + " as it is called here",
                    fmt::format("it is with {}", fmt::join(choices, " or "))});
}

void ScriptVariables::require_choice(const std::string& name, const std::string& value,
                                     const std::string& who) const {
  const auto found = choices_.find(name);
  if (found == choices_.end() || found->second.empty() || contains(found->second, value)) return;
  // A file that the script names outside of its include lines may be one that it makes.
  std::istringstream lines(text_);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("include") && !line.starts_with('#') &&
        line.find(included_as_.at(name)) != line.npos)
      return;
  throw_user_error({who, name, value, fmt::format("be one of {}", fmt::join(found->second, ", ")),
                    "each is a file beside " + files::path(script_).filename().string()});
}

void ScriptVariables::require_no_two_for_one(const std::map<std::string, std::string>& given,
                                             const std::string& who) const {
  static const std::regex rule(R"(^#\s*-var (\w+) takes the place of (.*))"), word(R"(\w+)");
  std::istringstream lines(text_);
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_search(line, found, rule)) continue;
    const auto first = given.find(found[1]);
    if (first == given.end() || first->second == "none") continue;
    const std::string others = found[2];
    for (std::sregex_iterator other(others.begin(), others.end(), word), end; other != end; ++other)
      if (const auto second = given.find(other->str()); second != given.end())
        throw_user_error(
            {who, second->first, second->second,
             fmt::format("not be given beside -var {} {}", first->first, first->second),
             fmt::format("{} takes the place of {}; drop one of the two", first->first, others)});
  }
}

void ScriptVariables::require(const std::string& name, const std::string& who) const {
  if (contains(settable_, name)) return;
  const std::string script = files::path(script_).filename().string();
  if (contains(set_by_script_, name))
    throw_user_error(
        {who, "variable", name, "be one that -var can set",
         fmt::format("{} sets it itself; make that line `variable {} index VALUE`", script, name)});
  if (!uses(text_, name))
    throw_user_error({who, "variable", name, "be used by " + script, known_for(name, settable_)});
}

std::string ScriptVariables::fingerprint() const {
  return fingerprint_of(text_);
}

}  // namespace suffuse
