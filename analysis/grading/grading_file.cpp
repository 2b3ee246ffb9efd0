#include "grading/grading_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "files/csv_file.h"
#include "files/decimal_mark.h"
#include "files/text_input.h"
#include "grading/sieve_columns.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {

namespace {

using micromechanics::Grading;
using micromechanics::GradingClass;
using micromechanics::GradingPoint;

/// A row of the table, in m and in the unit of its amounts.
struct Size {
  double diameter = 0;
  double amount = 0;
  std::string where;  ///< file and line
};

struct Table {
  SieveColumns columns;
  std::vector<Size> sizes;    ///< from the finest to the coarsest
  std::optional<double> pan;  ///< the amount that passes all sieves, where it is given
};

double number_of(const std::string& cell, DecimalMark mark, const std::string& where,
                 const std::string& who) {
  const std::optional<double> value = parse_decimal(cell, mark);
  if (!value) throw_user_error({who, where, fmt::format("'{}'", cell), "be a finite number", ""});
  return *value;
}

double diameter_of(const std::string& cell, const SieveColumns& columns, DecimalMark mark,
                   const std::string& where, const std::string& who) {
  if (columns.size_kind == SizeKind::sieve_number) {
    const std::optional<double> opening = astm_sieve_opening(cell);
    if (!opening)
      throw_user_error({who, where, fmt::format("sieve '{}'", cell), "be one of ASTM E11",
                        "give its opening in a column sieve_mm"});
    return *opening;
  }
  const double value = number_of(cell, mark, where, who);
  return columns.size_kind == SizeKind::phi ? 1e-3 * std::exp2(-value) : value * columns.to_diameter;
}

Table read_table(const std::string& path, const std::string& who) {
  CsvFile file = read_csv(path, who);
  Table table;
  table.columns = sieve_columns(file.names, path, who);
  if (table.columns.size_kind == SizeKind::sieve_number) file = read_csv(path, who, true);
  const auto cell = [&](const CsvFile::Row& row, std::size_t column) { return row.cells[column]; };
  const bool pan_by_zero = table.columns.size_kind == SizeKind::diameter;
  const auto pan = [&](const std::string& size) {
    return is_pan(size) && (pan_by_zero || std::isdigit(static_cast<unsigned char>(size[0])) == 0);
  };
  std::vector<std::string> numbers;
  for (const CsvFile::Row& row : file.rows) {
    numbers.push_back(cell(row, table.columns.amount));
    if (table.columns.size_kind != SizeKind::sieve_number && !pan(cell(row, table.columns.size)))
      numbers.push_back(cell(row, table.columns.size));
  }
  const DecimalMark mark = decimal_mark_of(numbers, file.separator, fmt::format("{}: {}", who, path));
  for (const CsvFile::Row& row : file.rows) {
    const std::string where = fmt::format("{}, line {}", path, row.line);
    const std::string& size = cell(row, table.columns.size);
    if (pan(size)) {
      if (table.pan) throw_user_error({who, where, fmt::format("'{}'", size), "be there once", "as the pan"});
      const std::string& amount = cell(row, table.columns.amount);
      table.pan = amount.empty() ? 0 : number_of(amount, mark, where, who);
      continue;
    }
    table.sizes.push_back({diameter_of(size, table.columns, mark, where, who),
                           number_of(cell(row, table.columns.amount), mark, where, who), where});
  }
  if (table.sizes.size() < 2)
    throw_user_error({who, path, fmt::format("{} sizes", table.sizes.size()), "have at least two",
                      "one size alone has no distribution"});
  if (table.sizes.front().diameter > table.sizes.back().diameter)
    std::reverse(table.sizes.begin(), table.sizes.end());
  return table;
}

/// What stands for all of the mass where the name of the column does not tell.
double whole_of(const Table& table, double largest, const std::string& who) {
  if (table.columns.whole) return *table.columns.whole;
  for (const double whole : {100.0, 1.0})
    if (std::abs(largest / whole - 1) <= 5e-3) return whole;
  throw_user_error({who, "amount at the end of the curve", fmt::format("{:g}", largest), "be 100 or 1",
                    "add the size that all grains pass, or name the column percent_finer"});
}

Grading from_passing(const Table& table, const micromechanics::GapRule& rule, const std::string& who) {
  const bool coarser = table.columns.amount_kind == AmountKind::coarser;
  const double whole = whole_of(
      table, coarser ? table.pan.value_or(table.sizes.front().amount) : table.sizes.back().amount, who);
  if (table.pan && std::abs(*table.pan - (coarser ? whole : 0)) > 5e-3 * whole)
    throw_user_error({who, "amount of the pan", fmt::format("{:g}", *table.pan),
                      fmt::format("be {:g}", coarser ? whole : 0), "the curve ends there"});
  std::vector<GradingPoint> points;
  for (const Size& size : table.sizes)
    points.push_back({size.diameter, (coarser ? whole - size.amount : size.amount) / whole});
  return Grading::from_curve(points, rule);
}

/// Masses on sieves and in the pan, summed up from below.
Grading from_retained(const Table& table, const micromechanics::GapRule& rule, const std::string& who) {
  double total = table.pan.value_or(0);
  for (const Size& size : table.sizes) {
    if (size.amount < 0)
      throw_user_error({who, size.where, fmt::format("{:g}", size.amount), "not be negative", ""});
    total += size.amount;
  }
  const bool is_mass = !table.columns.whole && !table.columns.whole_by_largest;
  const double whole = is_mass ? total : whole_of(table, total, who);
  if (is_mass && !table.pan)
    throw_user_error({who, "what passes the finest sieve", "not given", "be there",
                      "add a row `pan`, with 0 if nothing did"});
  if (std::abs(total / whole - 1) > 5e-3)
    throw_user_error(
        {who, "sum of what is retained", fmt::format("{:g}", total), fmt::format("be {:g}", whole),
         table.pan
             ? "if these are sums from the coarsest sieve on, name the column cumulative_percent_retained"
             : "add a row `pan`; or, if these are sums, name the column cumulative_percent_retained"});
  if (table.sizes.back().amount > 0)
    throw_user_error({who, "amount on the coarsest sieve", fmt::format("{:g}", table.sizes.back().amount),
                      "be 0", "add the sieve that all grains pass: how coarse those are is not known"});
  std::vector<GradingPoint> points;
  double finer = table.pan.value_or(0);
  for (const Size& size : table.sizes) {
    points.push_back({size.diameter, finer / total});
    finer += size.amount;
  }
  points.back().finer = 1;
  return Grading::from_curve(points, rule);
}

Grading from_class_table(const Table& table, const micromechanics::GapRule& rule, const std::string& who) {
  const bool is_mass = !table.columns.whole;
  if (is_mass && table.sizes.size() > 3 &&
      std::all_of(table.sizes.begin(), table.sizes.end(),
                  [](const Size& size) { return is_sieve_opening(size.diameter); }))
    throw_user_error(
        {who, "masses", "at openings of sieves only", "be of grains of these sizes",
         "if they are what sieves retained, name the columns sieve_mm and retained_mass_g and add a row "
         "`pan`; else give mass_fraction"});
  double total = 0;
  std::vector<GradingClass> classes;
  for (const Size& size : table.sizes) {
    classes.push_back({size.diameter, size.amount});
    total += size.amount;
  }
  Grading grading = Grading::from_classes(classes, rule);
  if (!is_mass && std::abs(total / *table.columns.whole - 1) > 1e-3)
    throw_user_error({"grading", "sum of mass_fraction", fmt::format("{:g}", total),
                      fmt::format("be {:g} (within 0.1 %)", *table.columns.whole),
                      "give shares of the whole, or name the column mass_kg"});
  return grading;
}

}  // namespace

micromechanics::Grading read_grading(const std::string& path, const std::string& who,
                                     const micromechanics::GapRule& rule) {
  const Table table = read_table(path, who);
  try {
    switch (table.columns.amount_kind) {
      case AmountKind::finer:
      case AmountKind::coarser:
        return from_passing(table, rule, "grading");
      case AmountKind::retained:
        return from_retained(table, rule, "grading");
      case AmountKind::of_class:
        break;
    }
    return table.pan ? from_retained(table, rule, "grading") : from_class_table(table, rule, "grading");
  } catch (const UserError& problem) {
    throw UserError(fmt::format("{}: {}: {}", who, path, problem.what()));
  }
}

bool is_dump(const std::string& path, const std::string& who) {
  require_an_end(path, who);
  std::error_code ignored;
  if (std::filesystem::is_fifo(path, ignored))
    throw_user_error({who, "file", path, "be a file, not a pipe", "it is read more than once"});
  std::ifstream file(path);
  if (!file) throw_user_error({who, "file", path, "be readable", ""});
  std::string first;
  std::getline(file, first);
  // gzip's first two bytes: dumps may be compressed, gradings are not.
  return first.starts_with("ITEM:") || first.starts_with("\x1f\x8b");
}

}  // namespace suffuse::analysis
