#pragma once

#include <string>
#include <utility>
#include <vector>

#include "files/csv_file.h"

namespace suffuse::analysis {

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
