#include "suffuse/common/safe_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "suffuse/common/error.h"

namespace suffuse {

void wait_for_disk(const std::string& path, const std::string& who) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool written = file >= 0 && (fsync(file) == 0 || errno == EINVAL || errno == ENOSYS);
  const std::error_code problem(errno, std::generic_category());
  if (file >= 0) close(file);
  if (!written)
    throw_user_error({who, "file", path, "take what is written", problem.message() + "; is the disk full?"});
}

std::string one_name_of(const std::string& path) {
  // Absolute first: of "m.csv" and "./m.csv" that are not there yet, only the latter would become so.
  std::error_code problem;
  const std::filesystem::path full = std::filesystem::absolute(path, problem);
  if (problem) return path;
  const std::filesystem::path name = std::filesystem::weakly_canonical(full, problem);
  return problem ? path : name.string();
}

void require_writable(const std::string& path, const std::string& who) {
  std::error_code problem;
  const bool existed = std::filesystem::exists(path, problem);
  errno = 0;
  if (!std::ofstream(path, std::ios::app))
    throw_user_error(
        {who, "file", path, "be writable", fmt::format("check its folder ({})", std::strerror(errno))});
  if (!existed) std::filesystem::remove(path, problem);
}

void require_replaceable(const std::string& path, const std::string& who) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (status.type() == std::filesystem::file_type::none)
    throw_user_error({who, "file", path, "be a name that can be looked up", problem.message()});
  if (std::filesystem::is_directory(status))
    throw_user_error({who, "file", path, "be a file", "this is a folder; add a name"});
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw_user_error({who, "file", path, "be a regular file", "a device or a pipe would be replaced by it"});
}

std::optional<std::string> keep_earlier(const std::string& path, const std::string& who) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) return std::nullopt;
  const std::filesystem::path file = std::filesystem::canonical(path);
  const std::string earlier = file.string() + ".before";
  std::filesystem::rename(file, earlier, problem);
  if (problem) throw_user_error({who, "file", path, "be free to become " + earlier, problem.message()});
  return path + ".before";
}

SafeFile::SafeFile(std::string path, std::string who)
    : path_(std::move(path)), part_(path_ + ".part"), who_(std::move(who)) {
  require_replaceable(path_, who_);
  errno = 0;
  stream_.open(part_, std::ios::binary | std::ios::trunc);
  if (!stream_)
    throw_user_error({who_, "file", path_, "be writable",
                      fmt::format("check that the folder exists and is yours ({})", std::strerror(errno))});
}

SafeFile::~SafeFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;  // nothing more can be done in a destructor
  std::filesystem::remove(part_, ignored);
}

void SafeFile::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void SafeFile::commit() {
  stream_.close();
  std::error_code problem;
  if (stream_) wait_for_disk(part_, who_);
  if (stream_) std::filesystem::rename(part_, path_, problem);
  if (!stream_ || problem)
    throw_user_error({who_, "file", path_, "take what is written",
                      problem ? problem.message() : std::string("is the disk full?")});
  committed_ = true;
}

}  // namespace suffuse
