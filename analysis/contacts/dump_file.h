#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/text_input.h"
#include "suffuse/common/linear_algebra.h"

namespace suffuse::analysis {

/// What stands above the rows of one snapshot of a LIGGGHTS dump.
struct DumpHeader {
  enum class Kind { grains, entries };  ///< `dump custom` or `dump local`

  Kind kind = Kind::grains;
  std::int64_t step = 0;
  std::int64_t rows = 0;
  Vec3 box_low = Vec3::Zero();  ///< m
  Vec3 box_high = Vec3::Zero();
  bool periodic[3] = {false, false, false};
  std::vector<std::string> columns;
};

/// Snapshots of one dump file, one after the other, in constant memory. All mistakes in the file are
/// UserErrors that name the file and the line.
class DumpFile {
 public:
  /// `who` begins the messages.
  DumpFile(std::string path, std::string who);

  /// Moves to the next snapshot's header, past rows that were not read. False at the end of the file.
  bool next(DumpHeader& header);

  /// Reads all rows of the current snapshot. `wanted`: for each column of the header the place its number
  /// takes in a row's values, or −1 for columns that are not read. `take(values)` is called a row.
  template <class Take>
  void rows(std::span<const int> wanted, std::size_t places, Take&& take) {
    std::vector<double> values(places, 0.0);
    for (; rows_left_ > 0; --rows_left_) {
      read_row(wanted, values);
      take(std::span<const double>(values));
    }
  }

  const TextInput& input() const { return input_; }
  /// Ends with a UserError about the current line.
  [[noreturn]] void complain(const std::string& problem, const std::string& remedy) const;

 private:
  std::string_view must_have_line(const char* what);
  void read_row(std::span<const int> wanted, std::span<double> values);
  void read_box(DumpHeader& header, std::string_view flags);

  TextInput input_;
  std::string who_;
  std::int64_t rows_left_ = 0, step_ = 0;
  std::vector<std::string> columns_;
};

/// Words between blanks.
std::vector<std::string_view> words_of(std::string_view line);

}  // namespace suffuse::analysis
