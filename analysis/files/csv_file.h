#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace suffuse::analysis {

/// A CSV file as people's spreadsheets write it: read by libcsv (quotes, doubled quotes, line ends),
/// separated by the semicolons, tabs or commas of its first row. A byte-order mark, empty lines and lines
/// that begin with `#` are passed over, blanks around unquoted cells too.
struct CsvFile {
  struct Row {
    std::vector<std::string> cells;  ///< as many as there are names; those that the line lacks are empty
    std::int64_t line = 0;           ///< where the row begins, from 1
  };

  char separator = ',';
  std::vector<std::string> names;
  std::vector<Row> rows;
};

/// Reads all of it. `number_sign_rows`: "#4,97.9" is a row (a sieve's number), not a comment.
/// Throws UserError (`who` first, then file and line) on a file that cannot be read or is no text (UTF-16), a
/// quote that does not end, no row of names, and rows with more cells than names, as decimal commas or
/// thousands without quotes give: which number was meant cannot be told then.
CsvFile read_csv(const std::string& path, const std::string& who, bool number_sign_rows = false);

/// The cells of one line; those in quotes may have separators, and "" for a quote.
std::vector<std::string> csv_cells(const std::string& line, char separator = ',');
/// A text as a cell: in quotes where it needs them.
std::string csv_text(const std::string& text);

}  // namespace suffuse::analysis
