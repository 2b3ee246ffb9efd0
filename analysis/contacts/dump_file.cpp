#include "contacts/dump_file.h"

#include <fmt/format.h>

#include <cmath>

#include "files/number_parser.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

constexpr std::string_view kItem = "ITEM: ";

bool starts_with_item(std::string_view line, std::string_view item) {
  return line.starts_with(kItem) && line.substr(kItem.size()).starts_with(item);
}

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

}  // namespace

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while (at < line.size()) {
    while (at < line.size() && is_blank(line[at])) ++at;
    const std::size_t start = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    if (at > start) words.push_back(line.substr(start, at - start));
  }
  return words;
}

DumpFile::DumpFile(std::string path, std::string who) : input_(std::move(path), who), who_(std::move(who)) {}

void DumpFile::complain(const std::string& problem, const std::string& remedy) const {
  throw UserError(
      fmt::format("{}: {}, line {}: {}; {}", who_, input_.path(), input_.line_number(), problem, remedy));
}

std::string_view DumpFile::must_have_line(const char* what) {
  std::string_view line;
  if (!input_.next_line(line))
    complain(fmt::format("the file ends where {} should be", what),
             "it is cut short: was the run stopped while it wrote?");
  return line;
}

bool DumpFile::next(DumpHeader& header) {
  std::string_view line;
  for (; rows_left_ > 0; --rows_left_) must_have_line("a row");
  do {
    if (!input_.next_line(line)) return false;
  } while (words_of(line).empty());
  if (!starts_with_item(line, "TIMESTEP"))
    complain("no snapshot begins here (ITEM: TIMESTEP)",
             "is this a dump of LIGGGHTS (dump custom, dump local)?");
  header = {};
  if (!parse_integer(must_have_line("the step"), header.step))
    complain("the step is no whole number", "the file is damaged");
  bool have_box = false, have_rows = false;
  for (;;) {
    line = must_have_line("the header");
    if (starts_with_item(line, "NUMBER OF ")) {
      have_rows = true;
      header.kind = line.ends_with("ATOMS") ? DumpHeader::Kind::grains : DumpHeader::Kind::entries;
      if (!parse_integer(must_have_line("the number of rows"), header.rows) || header.rows < 0)
        complain("the number of rows is no count", "the file is damaged");
    } else if (starts_with_item(line, "BOX BOUNDS")) {
      have_box = true;
      const std::string flags(line.substr(kItem.size() + 10));
      read_box(header, flags);
    } else if (starts_with_item(line, "UNITS")) {
      const std::string units(must_have_line("the units"));
      if (units != "si") complain("the dump is in units " + units, "only si is understood");
    } else if (line.starts_with(kItem)) {
      break;  // the names of the columns
    } else {
      complain("this is no part of a header", "is this a dump of LIGGGHTS (dump custom, dump local)?");
    }
  }
  if (!have_rows || !have_box)
    complain("the header lacks the number of rows or the box", "is the file whole?");
  const std::vector<std::string_view> names = words_of(line);
  for (std::size_t k = 2; k < names.size(); ++k) header.columns.emplace_back(names[k]);
  rows_left_ = header.rows;
  step_ = header.step;
  columns_ = header.columns;
  return true;
}

void DumpFile::read_box(DumpHeader& header, std::string_view flags) {
  const std::vector<std::string_view> faces = words_of(flags);
  if (faces.size() > 3) complain("the box is oblique", "only boxes with right angles are understood");
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    header.periodic[axis] = a < faces.size() && faces[a].starts_with('p');
    const std::vector<std::string_view> bounds = words_of(must_have_line("the box"));
    if (bounds.size() != 2 || !parse_number(bounds[0], header.box_low[axis]) ||
        !parse_number(bounds[1], header.box_high[axis]) || !(header.box_high[axis] > header.box_low[axis]))
      complain("the bounds of the box are not two rising numbers", "the file is damaged");
  }
}

void DumpFile::read_row(std::span<const int> wanted, std::span<double> values) {
  const std::string_view line = must_have_line("a row");
  if (!input_.line_has_end()) complain("the last line has no end", "the file is cut short");
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t column = 0; column < wanted.size(); ++column) {
    while (at < end && is_blank(*at)) ++at;
    if (at == end)
      complain(fmt::format("the row has {} values, the header {} names", column, wanted.size()),
               line.starts_with(kItem) ? "rows are missing before it" : "the file is cut short or damaged");
    if (wanted[column] < 0) {
      while (at < end && !is_blank(*at)) ++at;
      continue;
    }
    double& value = values[static_cast<std::size_t>(wanted[column])];
    const char* const stop = parse_number(at, end, value);
    const auto text = [&] {
      return std::string(words_of(std::string_view(at, static_cast<std::size_t>(end - at))).front());
    };
    if (stop == nullptr || (stop < end && !is_blank(*stop)))
      complain(fmt::format("{} = {} is no number", columns_[column], text()),
               line.starts_with(kItem) ? "rows are missing before it" : "the file is damaged");
    if (!std::isfinite(value))
      complain(fmt::format("{} = {} at step {}", columns_[column], text(), step_),
               "the run itself went wrong here: lower its time step, or leave this snapshot out");
    at = stop;
  }
  while (at < end && is_blank(*at)) ++at;
  if (at < end)
    complain(fmt::format("the row has more values than the header's {} names", wanted.size()),
             "the file is damaged");
}

}  // namespace suffuse::analysis
