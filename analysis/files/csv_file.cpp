#include "files/csv_file.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "files/text_input.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

/// libcsv's parser, one line at a time; cells of a row collect until the row ends, which may take several
/// lines.
class CellParser {
 public:
  explicit CellParser(char separator) {
    csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI);
    csv_set_delim(&parser_, static_cast<unsigned char>(separator));
  }
  ~CellParser() { csv_free(&parser_); }
  CellParser(const CellParser&) = delete;
  CellParser& operator=(const CellParser&) = delete;

  /// False where a quote stands where none may.
  bool take(std::string_view line) {
    const auto parse = [&](const char* text, std::size_t size) {
      return csv_parse(&parser_, text, size, add_cell, end_row, this) == size;
    };
    open_ = true;
    return parse(line.data(), line.size()) && parse("\n", 1);
  }
  /// False inside a quoted cell, which goes on in the next line.
  bool row_has_ended() const { return !open_; }
  std::vector<std::string> take_cells() { return std::move(cells_); }

 private:
  static void add_cell(void* text, std::size_t size, void* self) {
    static_cast<CellParser*>(self)->cells_.emplace_back(static_cast<const char*>(text), size);
  }
  static void end_row(int, void* self) { static_cast<CellParser*>(self)->open_ = false; }

  csv_parser parser_;
  std::vector<std::string> cells_;
  bool open_ = false;
};

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t") == line.npos;
}

bool is_comment(std::string_view line, bool number_sign_rows) {
  if (line.empty() || line[0] != '#') return false;
  return !(number_sign_rows && line.size() > 1 && std::isdigit(static_cast<unsigned char>(line[1])) != 0);
}

/// Of the row of names: a semicolon or tab outside quotes is one, as commas may stand in names.
char separator_of(std::string_view line) {
  std::size_t semicolons = 0, tabs = 0;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    semicolons += !quoted && c == ';' ? 1 : 0;
    tabs += !quoted && c == '\t' ? 1 : 0;
  }
  return semicolons > 0 ? ';' : tabs > 0 ? '\t' : ',';
}

void check_encoding(std::string_view& line, const std::string& path, const std::string& who) {
  if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF") || line.find('\0') != line.npos)
    throw_user_error({who, path, "UTF-16 or no text", "be text in UTF-8", "save it as CSV (UTF-8)"});
}

/// Surplus cells that are empty are a spreadsheet's; others make every number of the row doubtful.
void fit_to_names(CsvFile::Row& row, const CsvFile& file, const std::string& path, const std::string& who) {
  const auto surplus = [&](const std::string& cell) { return !cell.empty(); };
  const std::size_t names = file.names.size();
  if (row.cells.size() > names &&
      std::any_of(row.cells.begin() + static_cast<std::ptrdiff_t>(names), row.cells.end(), surplus))
    throw_user_error(
        {who, fmt::format("{}, line {}", path, row.line), fmt::format("{} cells", row.cells.size()),
         fmt::format("be {}, one a name of the first row", names),
         file.separator == ',' ? "are there commas in its numbers? then separate cells by semicolons, or put "
                                 "numbers in quotes"
                               : "name every column"});
  row.cells.resize(names);
}

}  // namespace

CsvFile read_csv(const std::string& path, const std::string& who, bool number_sign_rows) {
  TextInput input(path, who);
  CsvFile file;
  std::string_view line;
  bool has_line = input.next_line(line);
  if (has_line) check_encoding(line, path, who);
  while (has_line && (is_blank(line) || is_comment(line, false))) has_line = input.next_line(line);
  if (!has_line) throw_user_error({who, path, "nothing", "have a row of names", ""});
  file.separator = separator_of(line);
  CellParser parser(file.separator);
  CsvFile::Row row;
  do {
    if (parser.row_has_ended() && (is_blank(line) || is_comment(line, number_sign_rows))) continue;
    if (parser.row_has_ended()) row.line = input.line_number();
    if (!parser.take(line))
      throw_user_error({who, fmt::format("{}, line {}", path, input.line_number()), std::string(line),
                        "have quotes around whole cells only", "write a quote in a cell twice"});
    if (!parser.row_has_ended()) continue;
    row.cells = parser.take_cells();
    if (file.names.empty()) {
      file.names = std::move(row.cells);
    } else {
      fit_to_names(row, file, path, who);
      file.rows.push_back(std::move(row));
    }
    row = {};
  } while (input.next_line(line));
  if (!parser.row_has_ended())
    throw_user_error({who, fmt::format("{}, line {}", path, row.line), "a quote that does not end",
                      "end in the file", "close it"});
  return file;
}

std::vector<std::string> csv_cells(const std::string& line, char separator) {
  if (is_blank(line)) return {""};
  CellParser parser(separator);
  if (!parser.take(line) || !parser.row_has_ended())
    throw_user_error(
        {"csv", "line", line, "have quotes around whole cells only", "write a quote in a cell twice"});
  return parser.take_cells();
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",;\t\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace suffuse::analysis
