#include "files/csv_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "files/number_parser.h"
#include "files/text_input.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

using Row = std::vector<std::string>;

struct Table {
  Row names;
  std::vector<Row> rows;
};

Table read_table(const std::string& path, const std::string& who) {
  TextInput input(path, who);
  Table table;
  for (std::string_view line; input.next_line(line);) {
    if (line.empty() || line[0] == '#') continue;
    Row cells = csv_cells(std::string(line));
    if (table.names.empty()) {
      table.names = std::move(cells);
    } else {
      cells.resize(table.names.size());
      table.rows.push_back(std::move(cells));
    }
  }
  return table;
}

std::size_t column_of(const Table& table, const std::string& name, const std::string& path,
                      const std::string& who) {
  const auto found = std::find(table.names.begin(), table.names.end(), name);
  if (found == table.names.end())
    throw_user_error(
        {who, path, "no column " + name, "have it", fmt::format("it has {}", fmt::join(table.names, ", "))});
  return static_cast<std::size_t>(found - table.names.begin());
}

/// What a reader may have meant: the values of the last column asked for.
std::string values_in(const Table& table, std::size_t column) {
  std::vector<std::string> values;
  for (const Row& row : table.rows)
    if (std::find(values.begin(), values.end(), row[column]) == values.end() && values.size() < 12)
      values.push_back(row[column]);
  return fmt::format("{}", fmt::join(values, ", "));
}

double number_in(const std::string& text, const CsvCell& cell, const std::string& who) {
  double value = 0;
  if (!parse_number(std::string_view(text), value))
    throw_user_error(
        {who, cell.file, fmt::format("\"{}\" in column {}", text, cell.column), "be a number", ""});
  return value;
}

}  // namespace

double read_csv_cell(const CsvCell& cell, const std::string& who) {
  const Table table = read_table(cell.file, who);
  const std::size_t column = column_of(table, cell.column, cell.file, who);
  if (!cell.where.empty()) {
    std::vector<std::size_t> columns;
    for (const auto& [name, value] : cell.where) columns.push_back(column_of(table, name, cell.file, who));
    for (const Row& row : table.rows) {
      bool fits = true;
      for (std::size_t k = 0; k < columns.size(); ++k) fits = fits && row[columns[k]] == cell.where[k].second;
      if (fits) return number_in(row[column], cell, who);
    }
    std::string wanted;
    for (const auto& [name, value] : cell.where) wanted += (wanted.empty() ? "" : ", ") + name + '=' + value;
    throw_user_error(
        {who, cell.file, "no row with " + wanted, "have one",
         fmt::format("its {} are {}", cell.where.back().first, values_in(table, columns.back()))});
  }
  if (table.rows.empty()) throw_user_error({who, cell.file, "no row", "have one", ""});
  std::vector<double> values;
  for (const Row& row : table.rows) values.push_back(number_in(row[column], cell, who));
  switch (cell.take) {
    case CsvCell::Take::first:
      return values.front();
    case CsvCell::Take::largest:
      return *std::max_element(values.begin(), values.end());
    case CsvCell::Take::smallest:
      return *std::min_element(values.begin(), values.end());
    case CsvCell::Take::mean: {
      double sum = 0;
      for (const double value : values) sum += value;
      return sum / static_cast<double>(values.size());
    }
    case CsvCell::Take::last:
      break;
  }
  return values.back();
}

}  // namespace suffuse::analysis
