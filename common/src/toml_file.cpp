#include "suffuse/common/toml_file.h"
#include "suffuse/common/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

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
    if (text.substr(at).starts_with(end)) {
      // Of up to five marks at the end of a quote of three the first two are text.
      const std::size_t last = end.size() == 3 ? std::min(text.size(), at + 5) : at + 1;
      for (at += end.size(); at < last && text[at] == mark; ++at) {
      }
      return at;
    }
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

/// toml++ 3.3 runs into undefined behaviour (a switch without the case) at letters outside of ASCII wherever
/// it does not expect text, in what is no TOML too: it is given none. Bytes of them become %C3 and so on, and
/// % becomes %25.
std::string in_ascii(std::string_view text) {
  std::string ascii;
  for (const char c : text)
    if (const auto byte = static_cast<unsigned char>(c); byte > 127 || c == '%')
      ascii += fmt::format("%{:02X}", byte);
    else
      ascii += c;
  return ascii;
}

std::string out_of_ascii(std::string_view ascii) {
  std::string text;
  for (std::size_t at = 0; at < ascii.size(); ++at) {
    int byte = 0;
    const char* const digits = ascii.data() + at + 1;
    if (ascii[at] == '%' && at + 2 < ascii.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      text += static_cast<char>(byte);
      at += 2;
    } else {
      text += ascii[at];
    }
  }
  return text;
}

void take_out_of_ascii(toml::node& node) {
  if (auto* text = node.as_string()) {
    text->get() = out_of_ascii(text->get());
  } else if (auto* array = node.as_array()) {
    for (toml::node& element : *array) take_out_of_ascii(element);
  } else if (auto* table = node.as_table()) {
    std::vector<std::string> keys;
    toml::array values;
    for (auto&& [key, value] : *table) {
      take_out_of_ascii(value);
      if (key.str().find('%') != std::string_view::npos) keys.emplace_back(key.str());
    }
    for (const std::string& key : keys) {
      table->get(key)->visit([&](auto& value) { values.push_back(std::move(value)); });
      table->erase(key);
    }
    for (std::size_t n = 0; n < keys.size(); ++n)
      values[n].visit([&](auto& value) { table->insert(out_of_ascii(keys[n]), std::move(value)); });
  }
}

/// The line (from 1) of the first byte that is no UTF-8; 0 where there is none.
std::size_t line_of_no_utf8(std::string_view text) {
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t n) {
      return n < text.size() ? static_cast<unsigned char>(text[n]) : 0;
    };
    const int lead = byte(at);
    const std::size_t more = lead < 0x80   ? 0
                             : lead < 0xC2 ? 4
                             : lead < 0xE0 ? 1
                             : lead < 0xF0 ? 2
                             : lead < 0xF5 ? 3
                                           : 4;
    if (more == 4) return line;
    for (std::size_t n = 1; n <= more; ++n)
      if ((byte(at + n) & 0xC0) != 0x80) return line;
    if (lead == '\n') ++line;
    at += 1 + more;
  }
  return 0;
}

}  // namespace

toml::table read_toml(const std::string& path, const std::string& who) {
  std::ifstream file(path, std::ios::binary);
  if (!is_file(path) || !file)
    throw_user_error({who, "file", path, "be a file that can be read", "check the path"});
  std::string text{std::istreambuf_iterator<char>(file), {}};
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (std::string_view(text).starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  if (const std::size_t line = line_of_stray_letter(text); line > 0)
    throw UserError(
        fmt::format("{}, line {}: letters outside of ASCII must stand in quotes or comments; put the name or "
                    "text in quotes",
                    path, line));
  if (const std::size_t line = line_of_no_utf8(text); line > 0)
    throw UserError(
        fmt::format("{}, line {}: letters must be written in UTF-8; save the file so", path, line));
  try {
    toml::table table = toml::parse(in_ascii(text), path);
    take_out_of_ascii(table);
    return table;
  } catch (const toml::parse_error& problem) {
    throw UserError(fmt::format("{}, line {}: {}", path, problem.source().begin.line,
                                out_of_ascii(problem.description())));
  }
}

}  // namespace suffuse
