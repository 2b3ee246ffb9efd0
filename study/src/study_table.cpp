#include "suffuse/study/study_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "files/csv_cell.h"
#include "files/record_table.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/study/study_extrapolation.h"

namespace suffuse::study {
namespace {

using Cells = std::vector<std::string>;

constexpr double kOtherLoad = 0.15;  // cores kept busy by others above which times are called disturbed

std::string number_or(const std::optional<double>& value, const char* otherwise) {
  return value ? analysis::full_precision(*value) : otherwise;
}

bool has_reference(const StudyQuantity& quantity) {
  return quantity.reference || quantity.by_finest;
}

/// Columns as wide as what is in them; texts to the left, numbers to the right.
std::string aligned(const std::vector<Cells>& lines, std::size_t texts) {
  std::vector<std::size_t> widths;
  for (const Cells& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  }
  std::string text;
  for (const Cells& line : lines) {
    std::string row;
    for (std::size_t k = 0; k < line.size(); ++k)
      row += k < texts ? fmt::format("{:<{}}  ", line[k], widths[k])
                       : fmt::format("{:>{}}  ", line[k], widths[k]);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
  }
  return text;
}

}  // namespace

const StudyRow& StudyTable::add(StudyRow row) {
  row.values.resize(study_.quantities.size());
  const auto after =
      std::upper_bound(rows_.begin(), rows_.end(), row.place,
                       [](std::size_t place, const StudyRow& other) { return place < other.place; });
  const auto at = after - rows_.begin();
  rows_.insert(after, std::move(row));
  work_out_errors();
  return rows_[static_cast<std::size_t>(at)];
}

bool StudyTable::none_finished() const {
  return std::none_of(rows_.begin(), rows_.end(),
                      [](const StudyRow& row) { return has_results(row.record); });
}

double StudyTable::seconds(const StudyRow& row) const {
  return time_ == StudyTime::wall ? row.record.wall : row.record.core;
}

std::optional<double> StudyTable::target_of(std::size_t quantity) const {
  if (study_.quantities[quantity].by_finest)
    for (const StudyRow& row : rows_)
      if (row.run.is_reference && row.record.status == RunRecord::Status::finished)
        return row.values[quantity];
  return study_.quantities[quantity].reference;
}

void StudyTable::work_out_errors() {
  for (StudyRow& row : rows_) {
    row.errors.assign(study_.quantities.size(), std::nullopt);
    row.error.reset();
    for (std::size_t k = 0; k < study_.quantities.size(); ++k) {
      const std::optional<double> target = target_of(k);
      if (!row.values[k] || !target || *target == 0) continue;
      row.errors[k] = relative_error(*row.values[k], *target);
      row.error = std::max(row.error.value_or(0), *counted_error(row, k));
    }
  }
  const std::vector<bool> front = pareto_front(trade_offs());
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].on_front = front[i];
}

/// The finest run takes no part: it has no error by definition.
std::vector<TradeOff> StudyTable::trade_offs(std::optional<std::size_t> quantity) const {
  std::vector<TradeOff> runs;
  for (const StudyRow& row : rows_) {
    TradeOff& run = runs.emplace_back(TradeOff{seconds(row), std::nullopt});
    if (row.run.is_reference || row.record.status != RunRecord::Status::finished) continue;
    run.error = quantity ? counted_error(row, *quantity) : row.error;
  }
  return runs;
}

std::optional<double> StudyTable::counted_error(const StudyRow& row, std::size_t quantity) const {
  if (!row.errors[quantity]) return std::nullopt;
  return std::max(std::abs(*row.errors[quantity]), study_.quantities[quantity].uncertainty);
}

std::vector<std::size_t> StudyTable::by_time() const {
  std::vector<std::size_t> order(rows_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return seconds(rows_[a]) < seconds(rows_[b]); });
  return order;
}

std::string StudyTable::finished_text(const std::vector<Note>& notes) const {
  std::vector<Cells> lines{{""}};
  for (const std::string& name : swept_names(study_)) lines[0].push_back(name);
  const std::size_t texts = lines[0].size();
  for (const char* title : {"wall s", "core s"}) lines[0].push_back(title);
  for (const StudyQuantity& quantity : study_.quantities) {
    lines[0].push_back(quantity.name);
    if (has_reference(quantity)) lines[0].push_back("error");
  }
  if (!notes.empty()) lines[0].push_back("notes");
  for (const std::size_t i : by_time()) {
    const StudyRow& row = rows_[i];
    if (!has_results(row.record)) continue;
    const bool unsteady = row.record.status == RunRecord::Status::unsteady;
    Cells cells{row.on_front ? "*" : unsteady ? "u" : row.run.is_reference ? "r" : ""};
    for (const auto& [name, value] : row.run.swept) cells.push_back(value);
    cells.push_back(fmt::format("{:.3g}", row.record.wall));
    cells.push_back(fmt::format("{:.3g}", row.record.core));
    for (std::size_t k = 0; k < study_.quantities.size(); ++k) {
      cells.push_back(row.values[k] ? fmt::format("{:.5g}", *row.values[k]) : "-");
      if (has_reference(study_.quantities[k]))
        cells.push_back(row.errors[k] ? fmt::format("{:+.2g} %", 100 * *row.errors[k]) : "-");
    }
    if (!notes.empty()) cells.push_back(numbers_of(row, notes));
    lines.push_back(std::move(cells));
  }
  return aligned(lines, texts);
}

/// Runs that ended in the same way together.
std::string StudyTable::failed_text(const std::vector<Note>& notes) const {
  std::vector<std::pair<std::string, std::string>> reasons;  // and the runs of each
  for (const StudyRow& row : rows_) {
    if (row.record.status == RunRecord::Status::finished) continue;
    const std::string reason = fmt::format("{}: {}", to_string(row.record.status), row.record.reason);
    auto known =
        std::find_if(reasons.begin(), reasons.end(), [&](const auto& one) { return one.first == reason; });
    if (known == reasons.end()) known = reasons.emplace(reasons.end(), reason, "");
    known->second += fmt::format("  {} ({:.3g} s)", variables_text(row.run.swept), row.record.wall);
    if (!row.record.notes.empty()) known->second += ", notes " + numbers_of(row, notes);
    known->second += '\n';
  }
  std::string text;
  for (const auto& [reason, runs] : reasons) text += reason + '\n' + runs;
  return text;
}

/// Each kind of note once, in the order of the rows, its first text, and how many runs have it.
std::vector<StudyTable::Note> StudyTable::notes() const {
  std::vector<Note> all;
  for (const StudyRow& row : rows_)
    for (const std::string& text : row.record.notes) {
      const std::string kind = kind_of_note(text);
      auto known = std::find_if(all.begin(), all.end(), [&](const Note& one) { return one.kind == kind; });
      if (known == all.end()) known = all.insert(all.end(), Note{kind, text, 0});
      ++known->runs;
    }
  return all;
}

/// The numbers of a run's notes in that list: "1, 3".
std::string StudyTable::numbers_of(const StudyRow& row, const std::vector<Note>& notes) const {
  std::set<std::ptrdiff_t> numbers;
  for (const std::string& text : row.record.notes)
    numbers.insert(1 + (std::find_if(notes.begin(), notes.end(),
                                     [&](const Note& one) { return one.kind == kind_of_note(text); }) -
                        notes.begin()));
  return fmt::format("{}", fmt::join(numbers, ", "));
}

std::string StudyTable::notes_text(const std::vector<Note>& notes) const {
  if (notes.empty()) return "";
  std::string text = "notes of the runs, each as the first that has it says it:\n";
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += fmt::format("  {} ({}): {}\n", k + 1, count_text(notes[k].runs, "run"), notes[k].text);
  return text;
}

/// A line a group of runs and quantity.
std::string StudyTable::extrapolated_text() const {
  const std::vector<StudyExtrapolation> groups = extrapolations(study_, rows_);
  if (groups.empty()) return "";
  std::vector<Cells> lines;
  for (const StudyExtrapolation& group : groups)
    for (std::size_t k = 0; k < study_.quantities.size(); ++k) {
      const GridConvergence& found = group.of_quantities[k];
      Cells& cells = lines.emplace_back();
      for (const auto& [name, value] : rows_[group.rows.front()].run.swept)
        cells.push_back(name == study_.extrapolate->variable ? group.resolutions : value);
      cells.push_back(study_.quantities[k].name);
      cells.push_back(to_text(found));
      const std::optional<double> target = target_of(k);
      if (found.value && target && *target != 0 && !study_.quantities[k].by_finest)
        cells.push_back(fmt::format("error {:+.2g} ± {:.2g} %", 100 * relative_error(*found.value, *target),
                                    100 * *found.error_bar / std::abs(*target)));
    }
  return fmt::format("extrapolated by {}, its bar as wide as the finest run's grid convergence index:\n{}",
                     study_.extrapolate->variable, aligned(lines, swept_names(study_).size() + 3));
}

std::string StudyTable::text() const {
  const bool by_wall = time_ == StudyTime::wall;
  const std::vector<Note> notes = this->notes();
  std::string text = finished_text(notes);
  if (judged() > 0)
    text += fmt::format("*: no other run is both faster ({} time) and more accurate{}\n",
                        by_wall ? "wall" : "core", study_.finest.empty() ? "" : "; r: the reference");
  if (std::any_of(rows_.begin(), rows_.end(),
                  [](const StudyRow& row) { return row.record.status == RunRecord::Status::unsteady; }))
    text += "u: not steady yet; takes no part, nor is it a reference\n";
  text += extrapolated_text();
  text += failed_text(notes);
  text += notes_text(notes);
  double other = 0;
  for (const StudyRow& row : rows_) other = std::max(other, row.record.other_cores);
  if (other > kOtherLoad && by_wall)
    text += fmt::format(
        "note: {} kept up to {:.1f} cores busy; wall times suffer from that, --time core less\n",
        several_at_once_ ? "runs beside each other, or other programs," : "other programs", other);
  return text;
}

std::ptrdiff_t StudyTable::judged() const {
  return std::count_if(study_.quantities.begin(), study_.quantities.end(), has_reference);
}

std::string StudyTable::verdict() const {
  if (judged() == 0) return "no quantity has a reference to judge by";
  std::string text = sentence(trade_offs());
  for (std::size_t k = 0; k < study_.quantities.size() && judged() > 1; ++k)
    if (has_reference(study_.quantities[k]))
      text += fmt::format("\n  {} alone: {}", study_.quantities[k].name, sentence(trade_offs(k)));
  return text;
}

std::string StudyTable::sentence(const std::vector<TradeOff>& runs) const {
  const auto told = [&](std::size_t i) {
    return fmt::format("{}, {:.3g} s (error {:.2g} %)", variables_text(rows_[i].run.swept), seconds(rows_[i]),
                       100 * *runs[i].error);
  };
  if (const auto best = fastest_within(runs, study_.within))
    return fmt::format("fastest within {:g} %: {}", 100 * study_.within, told(*best));
  if (const auto best = most_accurate(runs))
    return fmt::format("no run is within {:g} %; the most accurate: {}", 100 * study_.within, told(*best));
  return "no run has an error to judge by";
}

void StudyTable::write_csv(const std::string& path) const {
  SafeFile file(path, "suffuse-study");
  std::string line;
  for (const std::string& name : swept_names(study_)) line += name + ',';
  for (const auto& [name, value] : study_.fixed) line += name + ',';
  line += "status,wall_s,core_s,other_cores";
  for (const StudyQuantity& quantity : study_.quantities)
    line += fmt::format(",{0},{0}_reference,{0}_error", analysis::csv_text(quantity.name));
  file.write(line + ",error,front,is_reference,reason,notes" + extrapolation_titles(study_) + '\n');
  const std::vector<StudyExtrapolation> groups = extrapolations(study_, rows_);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const StudyRow& row = rows_[i];
    line.clear();
    for (const auto& [name, value] : row.run.swept) line += analysis::csv_text(value) + ',';
    for (const auto& [name, value] : study_.fixed) line += analysis::csv_text(value) + ',';
    line += fmt::format("{},{:.4g},{:.4g},{:.2f}", to_string(row.record.status), row.record.wall,
                        row.record.core, row.record.other_cores);
    for (std::size_t k = 0; k < study_.quantities.size(); ++k)
      line += fmt::format(",{},{},{}", number_or(row.values[k], ""), number_or(target_of(k), ""),
                          row.errors[k] ? fmt::format("{:.6g}", *row.errors[k]) : "");
    line += fmt::format(",{},{:d},{:d},{},{}", row.error ? fmt::format("{:.6g}", *row.error) : "",
                        row.on_front, row.run.is_reference, analysis::csv_text(row.record.reason),
                        analysis::csv_text(fmt::format("{}", fmt::join(row.record.notes, "; "))));
    file.write(line + extrapolation_cells(study_, groups, i) + '\n');
  }
  file.commit();
}

}  // namespace suffuse::study
