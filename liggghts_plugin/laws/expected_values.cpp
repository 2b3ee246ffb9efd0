#include "expected_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "suffuse/common/error.h"

namespace suffuse {
namespace {

/// Rows of this case hold for every other that has none of its own for the quantity.
constexpr std::string_view kAnyCase = "any";
constexpr std::string_view kHeader = "case,quantity,value,tolerance,unit,source";

/// Splits at commas outside double quotes; quotes are dropped.
std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

double to_number(const std::string& text, const std::string& where) {
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || end != text.data() + text.size())
    throw_user_error({where, "value", text.empty() ? "nothing" : text, "be a number", ""});
  return value;
}

}  // namespace

std::vector<ExpectedValue> read_expected_values(std::istream& file, const std::string& name) {
  std::vector<ExpectedValue> values;
  std::string line;
  bool header_seen = false;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    if (!header_seen) {
      if (line != kHeader)
        throw_user_error(
            {name, fmt::format("line {}", number), line, fmt::format("be the header {}", kHeader), ""});
      header_seen = true;
      continue;
    }
    const std::string where = fmt::format("{} line {}", name, number);
    const auto cells = split(line);
    if (cells.size() != 6)
      throw_user_error({where, "cells", std::to_string(cells.size()), "be 6", std::string(kHeader)});
    values.push_back({cells[0], cells[1], to_number(cells[2], where),
                      cells[3].empty() ? 0.0 : to_number(cells[3], where), cells[4], cells[5]});
  }
  return values;
}

std::string comparison_table(const std::vector<MeasuredValue>& measured,
                             const std::vector<ExpectedValue>& expected, std::string_view case_name) {
  constexpr const char* row = "{:<36} {:>12} {:>12} {:>10} {:>4} {:>9}  {}\n";
  const auto number = [](std::optional<double> value) { return value ? fmt::format("{:.5g}", *value) : "-"; };
  std::string table =
      fmt::format(row, "quantity", "measured", "expected", "allowed", "ok", "diff %", "source");
  for (const MeasuredValue& m : measured) {
    const auto row_of = [&](std::string_view name) {
      return std::find_if(expected.begin(), expected.end(), [&](const ExpectedValue& e) {
        return e.case_name == name && e.quantity == m.quantity;
      });
    };
    auto match = row_of(case_name);
    if (match == expected.end()) match = row_of(kAnyCase);
    if (match == expected.end()) {
      table += fmt::format(row, m.quantity, number(m.value), "-", "-", "-", "-", "");
      continue;
    }
    const std::string label =
        match->unit == "-" ? m.quantity : fmt::format("{} [{}]", m.quantity, match->unit);
    const std::string difference =
        m.value && match->value != 0 ? fmt::format("{:+.1f}", 100 * (*m.value / match->value - 1)) : "-";
    const bool judged = match->tolerance > 0;
    const bool within = m.value && std::abs(*m.value - match->value) <= match->tolerance;
    table += fmt::format(row, label, number(m.value), number(match->value),
                         judged ? fmt::format("{:.3g}", match->tolerance) : "-",
                         !judged  ? "-"
                         : within ? "yes"
                                  : "NO",
                         difference, match->source);
  }
  return table;
}

}  // namespace suffuse
