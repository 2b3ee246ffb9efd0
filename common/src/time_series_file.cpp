#include "suffuse/common/time_series_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/safe_file.h"

namespace suffuse {

namespace {

constexpr double kBeforeAll = -std::numeric_limits<double>::infinity();

/// The header and the whole rows that stay.
struct KeptRows {
  std::uintmax_t bytes = 0;
  double last_time = kBeforeAll;
};

/// None if the file has another header.
std::optional<KeptRows> kept_rows(const std::string& path, const std::string& header,
                                  const SeriesContinuation& continues) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != header || file.eof()) return std::nullopt;
  KeptRows kept{line.size() + 1};
  const double limit = continues.after * (continues.same_run ? 1 + 1e-9 : 1 - 1e-9);
  while (std::getline(file, line) && !file.eof()) {
    const double time = std::strtod(line.c_str(), nullptr);
    if (!(continues.same_run ? time <= limit : time < limit)) break;
    kept.bytes += line.size() + 1;
    kept.last_time = time;
  }
  return kept;
}

[[noreturn]] void refuse_other_columns(const std::string& path, const std::string& header,
                                       const std::string& who) {
  throw_user_error({who, "file", path + ", which this run has written with other columns",
                    "take the columns " + header, "give it another FILE"});
}

}  // namespace

TimeSeriesFile::TimeSeriesFile(const std::string& path, const std::string& header, const std::string& who,
                               std::optional<SeriesContinuation> continues, MPI_Comm communicator)
    : path_(path), who_(who), communicator_(communicator), last_time_(kBeforeAll) {
  on_first_rank(who, communicator, [&] {
    require_writable(path, who);
    const auto kept = continues ? kept_rows(path, header, *continues) : std::nullopt;
    if (kept) {
      std::filesystem::resize_file(path, kept->bytes);
      last_time_ = kept->last_time;
    } else {
      if (continues && continues->same_run && is_there(path)) refuse_other_columns(path, header, who);
      earlier_ = keep_earlier(path, who).value_or("");
    }
    stream_.open(path, std::ios::app);
    if (!kept) stream_ << header << std::endl;
    if (!stream_) throw_user_error({who, "file", path, "take what is written", "is the disk full?"});
  });
  MPI_Bcast(&last_time_, 1, MPI_DOUBLE, 0, communicator);
}

void TimeSeriesFile::add(const std::vector<double>& values) {
  on_first_rank(who_, communicator_, [&] {
    const auto whole = static_cast<std::uintmax_t>(stream_.tellp());
    stream_ << fmt::format("{}", fmt::join(values, ",")) << std::endl;
    if (stream_) return;
    stream_.close();
    std::error_code ignored;                              // of a device
    std::filesystem::resize_file(path_, whole, ignored);  // no half row
    throw_user_error({who_, "file", path_, "take what is written", "is the disk full?"});
  });
}

}  // namespace suffuse
