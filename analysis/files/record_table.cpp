#include "files/record_table.h"

#include <fmt/format.h>

#include <cmath>

namespace suffuse::analysis {

std::string full_precision(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return fmt::format("{:.0f}", value);
  return fmt::format("{}", value);
}

std::string number_cell(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? full_precision(*value) : std::string();
}

void CsvWriter::write(const Record& record) {
  std::string line;
  if (!has_header_) {
    for (const Entry& entry : record) line += std::string(line.empty() ? "" : ",") + entry.name;
    line += '\n';
    has_header_ = true;
  }
  bool first = true;
  for (const Entry& entry : record) {
    if (!first) line += ',';
    first = false;
    line += number_cell(entry.value);
  }
  file_.write(line + '\n');
}

void JsonWriter::write(const Record& record) {
  std::string object = has_rows_ ? ",\n{" : "[\n{";
  has_rows_ = true;
  for (const Entry& entry : record) {
    const std::string number = number_cell(entry.value);
    object += fmt::format("{}\"{}\": {}", object.back() == '{' ? "" : ", ", entry.name,
                          number.empty() ? "null" : number);
  }
  file_.write(object + '}');
}

void JsonWriter::commit() {
  file_.write(has_rows_ ? "\n]\n" : "[]\n");
  file_.commit();
}

ScreenTable::ScreenTable(std::vector<Column> columns, std::size_t rows_at_each_end)
    : columns_(std::move(columns)), ends_(rows_at_each_end) {}

void ScreenTable::add(const Record& record) {
  ++rows_;
  if (first_.size() < ends_) {
    first_.push_back(record);
    return;
  }
  last_.push_back(record);
  if (last_.size() > ends_) last_.pop_front();
}

std::string ScreenTable::text() const {
  constexpr int kWidth = 10;
  std::string text;
  for (const Column& column : columns_) text += fmt::format("{:>{}} ", column.title, kWidth);
  text += '\n';
  const auto add_row = [&](const Record& record) {
    for (const Column& column : columns_) {
      const std::optional<double> value = value_of(record, column.name);
      text += fmt::format("{:>{}} ", value && std::isfinite(*value) ? fmt::format("{:.5g}", *value) : "-",
                          kWidth);
    }
    text += '\n';
  };
  for (const Record& record : first_) add_row(record);
  if (rows_ > first_.size() + last_.size())
    text += fmt::format("{:>{}}\n", fmt::format("({} more)", rows_ - first_.size() - last_.size()), kWidth);
  for (const Record& record : last_) add_row(record);
  return text;
}

}  // namespace suffuse::analysis
