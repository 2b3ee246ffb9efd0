#include "verdict/thesis_tables.h"

#include <map>
#include <sstream>
#include <stdexcept>

#include "files/csv_cell.h"
#include "files/number_parser.h"
#include "verdict/thesis_tables_data.h"

namespace suffuse::analysis {
namespace {

/// Rows of a table, by column.
std::vector<std::map<std::string, std::string>> rows_of(const char* text) {
  std::istringstream lines(text);
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = csv_cells(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    if (cells.size() != names.size()) throw std::logic_error("a table of the thesis is damaged: " + line);
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (k == 0) rows.emplace_back();
      rows.back()[names[k]] = cells[k];
    }
  }
  return rows;
}

std::vector<ThesisRow> table_of(const char* text) {
  std::vector<ThesisRow> table;
  for (auto& cells : rows_of(text)) {
    const auto number = [&](const char* column) -> std::optional<double> {
      double value = 0;
      if (!parse_number(cells[column], value)) return std::nullopt;
      return value;
    };
    ThesisRow row;
    row.sample = cells["sample"];
    row.state = cells.contains("state") ? cells["state"] : "dense";
    row.relative_density = number("relative_density").value_or(0.95);
    row.kezdi = number("kezdi_ratio");
    row.constriction = number("constriction_ratio");
    row.kenney_lau = number("kenney_lau_ratio");
    row.grains = number("grains");
    row.porosity = number("porosity");
    row.void_ratio = number("void_ratio");
    row.coordination = number("coordination_number");
    row.alpha = number("alpha");
    row.experiment = cells["experiment"];
    row.note = cells["note"];
    table.push_back(row);
  }
  return table;
}

}  // namespace

const std::vector<ThesisRow>& thesis_table_4_1() {
  static const std::vector<ThesisRow> table = table_of(kThesisTable41);
  return table;
}

const std::vector<ThesisRow>& thesis_table_5_1() {
  static const std::vector<ThesisRow> table = table_of(kThesisTable51);
  return table;
}

}  // namespace suffuse::analysis
