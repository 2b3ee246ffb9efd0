#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/record.h"
#include "suffuse/common/safe_file.h"

namespace suffuse::analysis {

/// Records as rows of a CSV file, every number with the digits that give the same double again; an empty cell
/// where there is none.
class CsvWriter {
 public:
  CsvWriter(const std::string& path, const std::string& who) : file_(path, who) {}

  void write(const Record& record);
  void commit() { file_.commit(); }

 private:
  SafeFile file_;
  bool has_header_ = false;
};

/// The same as a JSON array of objects; null where there is none.
class JsonWriter {
 public:
  JsonWriter(const std::string& path, const std::string& who) : file_(path, who) {}

  void write(const Record& record);
  void commit();

 private:
  SafeFile file_;
  bool has_rows_ = false;
};

/// Some columns of a series for the screen; of a long one the first and the last rows, in constant memory.
class ScreenTable {
 public:
  /// Columns by name, and what stands above each.
  struct Column {
    const char* name;
    const char* title;
  };
  explicit ScreenTable(std::vector<Column> columns, std::size_t rows_at_each_end = 10);

  void add(const Record& record);
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::size_t ends_, rows_ = 0;
  std::vector<Record> first_;
  std::deque<Record> last_;
};

/// The shortest text that reads back as the same number; a whole number without a point.
std::string full_precision(double value);

/// The same as a cell of a table: empty where there is no number, or none that is finite.
std::string number_cell(const std::optional<double>& value);

}  // namespace suffuse::analysis
