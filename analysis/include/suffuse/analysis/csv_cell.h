#pragma once

#include <string>
#include <vector>

#include "suffuse/analysis/study_file.h"

namespace suffuse::analysis {

/// The cells of a line of a CSV file; those in quotes may have commas, and "" for a quote.
std::vector<std::string> csv_cells(const std::string& line);
/// A text as a cell: in quotes where it needs them.
std::string csv_text(const std::string& text);

/// Reads one number (lines that start with # are passed over). It may be nan or inf, as a run that went wrong
/// writes them. Throws UserError where the file, the column or the row is not there; the message tells what
/// is. `who` begins it.
double read_csv_cell(const CsvCell& cell, const std::string& who);

}  // namespace suffuse::analysis
