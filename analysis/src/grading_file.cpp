#include "suffuse/analysis/grading_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "suffuse/common/error.h"

namespace suffuse::analysis {

namespace {

using micromechanics::Grading;
using micromechanics::GradingClass;
using micromechanics::GradingPoint;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const auto comma = std::min(line.find(',', start), line.size());
    cells.push_back(trimmed(line.substr(start, comma - start)));
    start = comma + 1;
  }
  return cells;
}

struct Names {
  std::size_t size = 0, amount = 0;
  double to_diameter_in_metres = 1;
  std::string amount_name;
};

/// Where the sizes and the amounts stand; the file must have one of each.
Names columns_of(const std::vector<std::string>& header, const std::string& path, const std::string& who) {
  Names names;
  int sizes = 0, amounts = 0;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string& name = header[i];
    if (name == "diameter_m" || name == "diameter_mm" || name == "radius_m") {
      names.size = i;
      names.to_diameter_in_metres = name == "diameter_m" ? 1 : name == "radius_m" ? 2 : 1e-3;
      ++sizes;
    }
    if (name == "mass_fraction" || name == "mass_kg" || name == "percent_finer") {
      names.amount = i;
      names.amount_name = name;
      ++amounts;
    }
  }
  if (sizes != 1)
    throw_user_error({who, path, fmt::format("{} columns of sizes", sizes),
                      "have one column diameter_m, diameter_mm or radius_m", "name it in the first row"});
  if (amounts != 1)
    throw_user_error({who, path, fmt::format("{} columns of amounts", amounts),
                      "have one column mass_fraction, mass_kg or percent_finer", "name it in the first row"});
  return names;
}

double number_of(const std::vector<std::string>& cells, std::size_t column, const std::string& where,
                 const std::string& who) {
  const std::string cell = column < cells.size() ? cells[column] : "";
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0' || !std::isfinite(value))
    throw_user_error({who, where, fmt::format("'{}'", cell), "be a finite number", ""});
  return value;
}

std::vector<GradingPoint> read_rows(std::ifstream& file, const std::string& path, const std::string& who,
                                    std::string& amount_name) {
  std::vector<GradingPoint> rows;
  bool has_header = false;
  Names names;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    const auto cells = cells_of(line);
    if (!has_header) {
      names = columns_of(cells, path, who);
      has_header = true;
      continue;
    }
    const std::string where = fmt::format("{}, line {}", path, number);
    rows.push_back({number_of(cells, names.size, where, who) * names.to_diameter_in_metres,
                    number_of(cells, names.amount, where, who)});
  }
  if (!has_header) throw_user_error({who, path, "nothing", "hold a grading", ""});
  if (rows.size() < 2)
    throw_user_error({who, path, fmt::format("{} sizes", rows.size()), "have at least two",
                      "one size alone has no distribution"});
  amount_name = names.amount_name;
  return rows;
}

}  // namespace

micromechanics::Grading read_grading(const std::string& path, const std::string& who,
                                     const micromechanics::GapRule& rule) {
  std::ifstream file(path);
  if (!file) throw_user_error({who, "file", path, "be readable", ""});
  std::string amount;
  std::vector<GradingPoint> rows = read_rows(file, path, who, amount);
  if (rows.front().diameter > rows.back().diameter) std::reverse(rows.begin(), rows.end());
  try {
    if (amount == "percent_finer") {
      for (GradingPoint& row : rows) row.finer /= 100;
      return Grading::from_curve(rows, rule);
    }
    double total = 0;
    std::vector<GradingClass> classes;
    for (const GradingPoint& row : rows) {
      classes.push_back({row.diameter, row.finer});
      total += row.finer;
    }
    const Grading grading = Grading::from_classes(classes, rule);
    if (amount == "mass_fraction" && std::abs(total - 1) > 1e-3)
      throw_user_error({"grading", "sum of mass_fraction", fmt::format("{:g}", total), "be 1 (within 0.001)",
                        "give shares of the whole, or name the column mass_kg"});
    return grading;
  } catch (const UserError& problem) {
    throw UserError(fmt::format("{}: {}: {}", who, path, problem.what()));
  }
}

bool is_dump(const std::string& path, const std::string& who) {
  std::ifstream file(path);
  if (!file) throw_user_error({who, "file", path, "be readable", ""});
  std::string first;
  std::getline(file, first);
  // gzip's first two bytes: dumps may be compressed, gradings are not.
  return first.starts_with("ITEM:") || first.starts_with("\x1f\x8b");
}

}  // namespace suffuse::analysis
