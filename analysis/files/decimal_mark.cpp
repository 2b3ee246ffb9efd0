#include "files/decimal_mark.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "files/number_parser.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
}

/// "1,250,000": one to three digits (not a zero), then groups of three.
bool is_grouped(std::string_view text, char mark) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  std::size_t end = text.find(mark);
  if (end == text.npos || end > 3 || !all_digits(text.substr(0, end)) || text[0] == '0') return false;
  while (end != text.npos) {
    text.remove_prefix(end + 1);
    end = text.find(mark);
    const std::string_view group = text.substr(0, end);
    if (group.size() != 3 || !all_digits(group)) return false;
  }
  return true;
}

std::size_t count(std::string_view text, char mark) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), mark));
}

/// What one number shows; none where it shows nothing, and `doubtful` where it has a mark all the same.
std::optional<DecimalMark> shown_by(std::string_view text, bool& doubtful) {
  const std::size_t points = count(text, '.'), commas = count(text, ',');
  doubtful = false;
  if (points == 0 && commas == 0) return std::nullopt;
  if (points > 0 && commas > 0)
    return text.rfind('.') > text.rfind(',') ? DecimalMark::point : DecimalMark::comma;
  const char mark = points > 0 ? '.' : ',';
  const DecimalMark as_decimal = points > 0 ? DecimalMark::point : DecimalMark::comma;
  const DecimalMark as_group = points > 0 ? DecimalMark::comma : DecimalMark::point;
  if (points + commas > 1) return as_group;
  if (!is_grouped(text, mark)) return as_decimal;
  doubtful = true;
  return std::nullopt;
}

/// Signs that group thousands besides the other mark, as blanks.
std::string with_plain_blanks(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    std::size_t taken = 1;
    char next = text[0];
    for (const std::string_view blank : {"\xC2\xA0", "\xE2\x80\xAF", "'", "\xE2\x80\x99"})
      if (text.starts_with(blank)) {
        taken = blank.size();
        next = ' ';
      }
    plain += next;
    text.remove_prefix(taken);
  }
  return plain;
}

}  // namespace

DecimalMark decimal_mark_of(const std::vector<std::string>& numbers, char separator, const std::string& who) {
  std::optional<DecimalMark> mark;
  std::string shows, doubtful;
  for (const std::string& number : numbers) {
    bool doubt = false;
    const std::optional<DecimalMark> shown = shown_by(number, doubt);
    if (doubt && doubtful.empty()) doubtful = number;
    if (!shown) continue;
    if (mark && *mark != *shown)
      throw_user_error({who, "decimal marks", fmt::format("'{}' and '{}'", shows, number),
                        "be the same in all numbers", "write points"});
    mark = shown;
    shows = number;
  }
  if (mark) return *mark;
  const bool has_comma = doubtful.find(',') != doubtful.npos;
  if (has_comma || (!doubtful.empty() && separator == ';')) {
    std::string as_thousands = doubtful, as_decimal = doubtful;
    std::erase_if(as_thousands, [](char c) { return c == ',' || c == '.'; });
    std::replace(as_decimal.begin(), as_decimal.end(), ',', '.');
    throw_user_error({who, "number", fmt::format("'{}'", doubtful),
                      fmt::format("be {} or {}, which nothing in the file tells", as_decimal, as_thousands),
                      fmt::format("write {}0 or {}", as_decimal, as_thousands)});
  }
  return DecimalMark::point;
}

std::optional<double> parse_decimal(std::string_view cell, DecimalMark mark) {
  std::string text = with_plain_blanks(cell);
  if (text.ends_with('%')) text.pop_back();
  const auto first = text.find_first_not_of(' ');
  if (first == text.npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(' ') - first + 1);
  const char decimal = mark == DecimalMark::point ? '.' : ',', group = mark == DecimalMark::point ? ',' : '.';
  const std::size_t end = std::min(text.find(decimal), text.size());
  std::string number = text.substr(0, end);
  for (const char one : {group, ' '})
    if (number.find(one) != number.npos) {
      if (!is_grouped(number, one)) return std::nullopt;
      std::erase(number, one);
    }
  if (end < text.size()) number.append(".").append(text, end + 1, text.npos);
  double value = 0;
  if (!parse_number(std::string_view(number), value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace suffuse::analysis
