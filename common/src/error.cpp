#include "suffuse/common/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <sstream>
#include <system_error>
#include <vector>

#include "suffuse/common/near_word.h"

namespace suffuse {

namespace {

/// What was given, on one line of a screen whatever it was: no control characters, and not the whole of a
/// long text.
std::string shown(const std::string& text) {
  constexpr std::size_t most = 200;
  std::string line = text.substr(0, most);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text.size() > most ? line + "..." : line;
}

/// The words of a rule `be one of: a, b c or d`; none for other rules.
std::vector<std::string> words_of_rule(std::string rule) {
  constexpr std::string_view begin = "be one of";
  if (!rule.starts_with(begin)) return {};
  for (char& c : rule)
    if (c == ',' || c == ':') c = ' ';
  std::istringstream text(rule.substr(begin.size()));
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

std::string line_of(const InputProblem& problem) {
  std::string line =
      fmt::format("{}: {} = {}, must {}", problem.who, problem.what, shown(problem.value), problem.rule);
  // "unknown" is the value where the word itself is what is wrong.
  const std::string& word = problem.value == "unknown" ? problem.what : problem.value;
  const std::string meant = did_you_mean(word, words_of_rule(problem.rule));
  if (!meant.empty()) line += "; " + meant;
  if (!problem.remedy.empty()) line += (meant.empty() ? "; " : " ") + problem.remedy;
  return line;
}

}  // namespace

void throw_user_error(const InputProblem& problem) {
  throw UserError(line_of(problem));
}

void throw_lost_run(const InputProblem& problem) {
  throw LostRun(line_of(problem));
}

std::string refusal_of_the_machine(const std::exception& failure) {
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&failure)) {
    const std::string path = file->path1().empty() ? "." : file->path1().string();
    return fmt::format("file {}: {}", path, file->code().message());
  }
  if (const auto* system = dynamic_cast<const std::system_error*>(&failure))
    return fmt::format("a file or the screen cannot be written: {}", system->code().message());
  if (dynamic_cast<const std::bad_alloc*>(&failure) != nullptr)
    return "there is not enough memory for this input; take a part of it, or a larger machine";
  return {};
}

void require_printed_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw UserError(fmt::format("what is printed cannot be written: {}",
                              errno != 0 ? std::strerror(errno) : "output error"));
}

}  // namespace suffuse
