#include "hdf5_undo.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "suffuse/common/error.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/safe_file.h"

namespace suffuse {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "suffuse undo, version 1\n";

std::string undo_of(const std::string& path) {
  return path + ".undo";
}

/// What lies between the arrays' values in a file of this length, with the values of arrays that are too
/// small to be worth a part of their own.
std::vector<ArrayBytes> between(std::vector<ArrayBytes> data, std::uint64_t length) {
  std::sort(data.begin(), data.end(),
            [](const ArrayBytes& a, const ArrayBytes& b) { return a.from < b.from; });
  std::vector<ArrayBytes> rest;
  std::uint64_t at = 0;
  constexpr std::uint64_t small = 512;
  for (const ArrayBytes& part : data) {
    if (part.length < small) continue;
    if (part.from > at) rest.push_back({at, part.from - at});
    at = std::max(at, part.from + part.length);
  }
  if (at < length) rest.push_back({at, length - at});
  return rest;
}

template <class T>
void put(std::ostream& to, const T& value) {
  to.write(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class T>
T get(std::istream& from) {
  T value{};
  from.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

void copy_bytes(std::istream& from, std::ostream& to, std::uint64_t count) {
  std::array<char, 1 << 16> block;
  while (count > 0 && from && to) {
    const auto part = static_cast<std::streamsize>(std::min<std::uint64_t>(count, block.size()));
    from.read(block.data(), part);
    to.write(block.data(), part);
    count -= static_cast<std::uint64_t>(part);
  }
}

/// Straight from the file: a stream would read a whole block for each of many short parts.
class ReadFile {
 public:
  explicit ReadFile(const std::string& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~ReadFile() {
    if (file_ >= 0) close(file_);
  }
  ReadFile(const ReadFile&) = delete;
  ReadFile& operator=(const ReadFile&) = delete;

  /// Did the file have all of them?
  bool copy(ArrayBytes bytes, std::ostream& to) const {
    std::array<char, 1 << 16> block;
    while (bytes.length > 0) {
      const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.length, block.size()));
      const ssize_t got = pread(file_, block.data(), part, static_cast<off_t>(bytes.from));
      if (got <= 0) return false;
      to.write(block.data(), got);
      bytes.from += static_cast<std::uint64_t>(got);
      bytes.length -= static_cast<std::uint64_t>(got);
    }
    return true;
  }

 private:
  int file_;
};

}  // namespace

void write_undo(const std::string& path, std::uint64_t length, std::vector<ArrayBytes> data) {
  const std::string part = undo_of(path) + ".part";
  const std::vector<ArrayBytes> rest = between(std::move(data), length);
  std::vector<char> buffer(1 << 20);
  std::ofstream note;
  note.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  note.open(part, std::ios::binary | std::ios::trunc);
  const ReadFile file(path);
  bool whole = true;
  note << kMark;
  put(note, length);
  put(note, static_cast<std::uint64_t>(rest.size()));
  for (const ArrayBytes& bytes : rest) {
    put(note, bytes.from);
    put(note, bytes.length);
    whole = whole && file.copy(bytes, note);
  }
  note.close();
  if (!note || !whole) {
    std::error_code ignored;
    fs::remove(part, ignored);
    if (!whole) throw_user_error({"HDF5", "file", path, "be readable to its end", "check its disk"});
    throw_user_error({"HDF5", "file", path, "have room for a note beside it",
                      "make room on the disk; what was written before is whole"});
  }
  fs::rename(part, undo_of(path));  // whole from its first moment
}

void drop_undo(const std::string& path) {
  std::error_code ignored;
  fs::remove(undo_of(path), ignored);
}

bool has_undo(const std::string& path) {
  return is_there(undo_of(path));
}

void undo_if_killed(const std::string& path) {
  std::ifstream note(undo_of(path), std::ios::binary);
  if (!note) return;
  std::string mark(kMark.size(), '\0');
  note.read(mark.data(), static_cast<std::streamsize>(mark.size()));
  if (mark != kMark)
    throw_user_error(
        {"HDF5", "file", undo_of(path), "be a note of this version", "remove it, or the file with it"});
  const auto length = get<std::uint64_t>(note), count = get<std::uint64_t>(note);
  std::error_code ignored;
  if (length == 0 || !is_there(path)) {  // nothing there before, or taken away since
    fs::remove(path, ignored);
    drop_undo(path);
    return;
  }
  {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    for (std::uint64_t n = 0; n < count && note && file; ++n) {
      file.seekp(static_cast<std::streamoff>(get<std::uint64_t>(note)));
      copy_bytes(note, file, get<std::uint64_t>(note));
    }
    if (!file || !note)
      throw_user_error({"HDF5", "file", path, "take back what a killed run left in it", "check its folder"});
  }
  fs::resize_file(path, length);
  drop_undo(path);
}

std::optional<std::string> keep_earlier_hdf5(const std::string& path, const std::string& who) {
  undo_if_killed(path);
  return keep_earlier(path, who);
}

}  // namespace suffuse
