#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suffuse/study/study_cases.h"
#include "suffuse/study/study_record.h"
#include "suffuse/study/trade_off.h"

namespace suffuse::study {

/// Which seconds an error is held against.
enum class StudyTime { wall, core };

/// A run of a study that has ended.
struct StudyRow {
  std::size_t place = 0;  ///< of its run in the study: rows stand in this order
  StudyCase run;
  RunRecord record;
  std::vector<std::optional<double>> values;  ///< of the study's quantities, in their order
  std::vector<std::optional<double>> errors;  ///< relative, with their signs
  std::optional<double> error;  ///< the largest one, none counted as less than its reference is uncertain
  bool on_front = false;
};

/// The rows that have ended, with errors and Pareto's front.
class StudyTable {
 public:
  StudyTable(const Study& study, StudyTime time, bool several_at_once = false)
      : study_(study), time_(time), several_at_once_(several_at_once) {}

  /// Takes the row up and works out the errors that it changes. Gives the row with its errors.
  const StudyRow& add(StudyRow row);
  std::size_t size() const { return rows_.size(); }
  const std::vector<StudyRow>& rows() const { return rows_; }
  bool none_finished() const;

  /// For the screen: runs by their time, the front marked, with the numbers of their notes; those that failed
  /// with their reasons and the notes themselves below.
  std::string text() const;
  /// "fastest within 3 %: resolution=5, 12.3 s (error 1.6 %)"; where several quantities have a reference, a
  /// line for each of them alone behind it.
  std::string verdict() const;
  /// A row a run: variables, status, seconds, quantities, references, errors, front, reason, notes.
  void write_csv(const std::string& path) const;

 private:
  double seconds(const StudyRow& row) const;
  /// By the largest error, or by that of one quantity.
  std::vector<TradeOff> trade_offs(std::optional<std::size_t> quantity = std::nullopt) const;
  std::string sentence(const std::vector<TradeOff>& runs) const;
  /// What a quantity should be; nothing while the finest run has not ended, or where it was not steady.
  std::optional<double> target_of(std::size_t quantity) const;
  void work_out_errors();
  /// No smaller than the reference is uncertain.
  std::optional<double> counted_error(const StudyRow& row, std::size_t quantity) const;
  std::vector<std::size_t> by_time() const;
  std::ptrdiff_t judged() const;  ///< quantities with a reference
  struct Note {
    std::string kind, text;
    std::ptrdiff_t runs;
  };
  std::vector<Note> notes() const;
  std::string numbers_of(const StudyRow& row, const std::vector<Note>& notes) const;
  std::string finished_text(const std::vector<Note>& notes) const;
  std::string failed_text(const std::vector<Note>& notes) const;
  std::string notes_text(const std::vector<Note>& notes) const;
  std::string extrapolated_text() const;

  const Study& study_;
  StudyTime time_;
  bool several_at_once_;
  std::vector<StudyRow> rows_;
};

}  // namespace suffuse::study
