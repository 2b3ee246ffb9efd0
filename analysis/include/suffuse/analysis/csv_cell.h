#pragma once

#include <string>
#include <utility>
#include <vector>

namespace suffuse::analysis {

/// The cells of a line of a CSV file; those in quotes may have commas, and "" for a quote.
std::vector<std::string> csv_cells(const std::string& line);
/// A text as a cell: in quotes where it needs them.
std::string csv_text(const std::string& text);

/// A number in a CSV file: of the row in which the columns of `where` have these values, or, without `where`,
/// `take` of a whole column.
struct CsvCell {
  enum class Take { last, first, largest, smallest, mean };

  std::string file, column;
  std::vector<std::pair<std::string, std::string>> where;
  Take take = Take::last;
};

/// Reads one number (lines that start with # are passed over). It may be nan or inf, as a run that went wrong
/// writes them. Throws UserError where the file, the column or the row is not there; the message tells what
/// is. `who` begins it.
double read_csv_cell(const CsvCell& cell, const std::string& who);

}  // namespace suffuse::analysis
