#include "suffuse/common/time_series_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"

namespace suffuse {

namespace {

/// Bytes of the header and the whole rows before `time`; none if the file has another header.
std::optional<std::uintmax_t> rows_before(const std::string& path, const std::string& header, double time) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != header || file.eof()) return std::nullopt;
  std::uintmax_t kept = line.size() + 1;
  while (std::getline(file, line) && !file.eof()) {
    if (!(std::strtod(line.c_str(), nullptr) < time * (1 - 1e-9))) break;
    kept += line.size() + 1;
  }
  return kept;
}

}  // namespace

TimeSeriesFile::TimeSeriesFile(const std::string& path, const std::string& header, const std::string& who,
                               std::optional<double> continue_after, MPI_Comm communicator)
    : path_(path), who_(who), communicator_(communicator) {
  on_first_rank(who, communicator, [&] {
    require_writable(path, who);
    const auto kept = continue_after ? rows_before(path, header, *continue_after) : std::nullopt;
    if (kept)
      std::filesystem::resize_file(path, *kept);
    else
      earlier_ = keep_earlier(path, who).value_or("");
    stream_.open(path, std::ios::app);
    if (!kept) stream_ << header << std::endl;
    if (!stream_) throw_user_error({who, "file", path, "take what is written", "is the disk full?"});
  });
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
