#include "suffuse/common/toml_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "suffuse/common/error.h"

namespace suffuse {
namespace {

/// Where a quote that opens at `at` has closed, past its last mark; the end of the text where it does not.
/// Basic strings have escapes, and both kinds may be of three marks and many lines.
std::size_t past_quote(std::string_view text, std::size_t at) {
  const char mark = text[at];
  const std::string three(3, mark);
  const std::string_view end =
      text.substr(at).starts_with(three) ? std::string_view(three) : std::string_view(three).substr(2);
  for (at += end.size(); at < text.size(); ++at) {
    if (text.substr(at).starts_with(end)) return at + end.size();
    if (end.size() == 1 && text[at] == '\n') return at;
    if (mark == '"' && text[at] == '\\') ++at;
  }
  return text.size();
}

/// The line (from 1) of the first letter outside of ASCII, of quotes and of comments; 0 where there is none.
std::size_t line_of_stray_letter(std::string_view text) {
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) > 127) return line;
    std::size_t next = at + 1;
    if (c == '#') next = std::min(text.find('\n', at), text.size());
    if (c == '"' || c == '\'') next = past_quote(text, at);
    for (; at < next; ++at)
      if (text[at] == '\n') ++line;
  }
  return 0;
}

}  // namespace

toml::table read_toml(const std::string& path, const std::string& who) {
  std::ifstream file(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path) || !file)
    throw_user_error({who, "file", path, "be a file that can be read", "check the path"});
  std::string text{std::istreambuf_iterator<char>(file), {}};
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (std::string_view(text).starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  if (const std::size_t line = line_of_stray_letter(text); line > 0)
    throw UserError(
        fmt::format("{}, line {}: letters outside of ASCII must stand in quotes or comments; put the name or "
                    "text in quotes",
                    path, line));
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& problem) {
    throw UserError(fmt::format("{}, line {}: {}", path, problem.source().begin.line, problem.description()));
  }
}

}  // namespace suffuse
