#include "restart_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace suffuse::coupling {

namespace {

/// Flags of the header in the order of LIGGGHTS's write_restart.cpp; those that are not named hold an int.
enum Flag {
  version = 0,
  units = 4,
  ntimestep = 5,
  nprocs = 7,
  procgrid = 8,
  atom_style = 22,
  natoms = 23,
  nbonds = 25
};
constexpr int kLastFlag = 51;
bool is_text(int flag) {
  return flag == version || flag == units || flag == atom_style;
}
bool is_long(int flag) {
  return flag == ntimestep || flag == natoms || (flag >= nbonds && flag <= 34 && (flag - nbonds) % 3 == 0);
}
bool is_real(int flag) {
  return flag >= 37;
}

class Mapped {
 public:
  explicit Mapped(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat about {};
    if (file >= 0 && fstat(file, &about) == 0 && about.st_size > 0) {
      size_ = static_cast<std::size_t>(about.st_size);
      data_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
      if (data_ == MAP_FAILED) size_ = 0;
    }
    if (file >= 0) close(file);
  }
  ~Mapped() {
    if (size_ > 0) munmap(data_, size_);
  }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;

  std::size_t size() const { return size_; }
  /// False if the file ends before.
  template <class T>
  bool get(std::size_t& at, T& value) const {
    if (at > size_ || size_ - at < sizeof(T)) return false;
    std::memcpy(&value, static_cast<const char*>(data_) + at, sizeof(T));
    at += sizeof(T);
    return true;
  }
  std::string text(std::size_t at, std::size_t most) const {
    return at < size_ ? std::string(static_cast<const char*>(data_) + at, std::min(most, size_ - at)) : "";
  }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

struct Header {
  std::int64_t grains = -1;
  int ranks = -1;
  std::array<int, 3> grid{};
  std::size_t end = 0;
  bool hybrid = false;
};

bool read_header(const Mapped& file, Header& header) {
  std::size_t at = 0;
  int flag = 0;
  while (file.get(at, flag)) {
    int whole = 0;
    std::int64_t large = 0;
    double real = 0;
    bool got = true;
    if (flag == -1) {
      header.end = at;
      return header.grains >= 0 && header.ranks > 0;
    }
    if (flag < 0 || flag > kLastFlag) return false;
    if (is_text(flag)) {
      got = file.get(at, whole) && whole > 0 && static_cast<std::size_t>(whole) <= file.size() - at;
      if (got && flag == atom_style && file.text(at, 6) == "hybrid") {
        header.hybrid = true;
        return true;
      }
      at += got ? static_cast<std::size_t>(whole) : 0;
    } else if (is_long(flag)) {
      got = file.get(at, large);
      if (flag == natoms) header.grains = large;
    } else if (is_real(flag)) {
      got = file.get(at, real);
    } else {
      got = file.get(at, whole);
      if (flag == nprocs) header.ranks = whole;
      if (flag >= procgrid && flag < procgrid + 3)
        header.grid[static_cast<std::size_t>(flag - procgrid)] = whole;
    }
    if (!got) return false;
  }
  return false;
}

/// Do the grains of all ranks begin at `at`, and does the file end with them?
bool grains_follow(const Mapped& file, std::size_t at, const Header& header) {
  std::int64_t grains = 0;
  for (int rank = 0; rank < header.ranks; ++rank) {
    int values = 0;
    if (!file.get(at, values) || values < 0 || static_cast<std::size_t>(values) > (file.size() - at) / 8)
      return false;
    const std::size_t end = at + 8 * static_cast<std::size_t>(values);
    while (at < end) {
      std::size_t from = at;
      double length = 0;
      if (!file.get(from, length) || !(length >= 1) || length > values || length != std::floor(length))
        return false;
      at += 8 * static_cast<std::size_t>(length);
      ++grains;
    }
    if (at != end) return false;
  }
  return at == file.size() && grains == header.grains;
}

}  // namespace

bool is_whole_restart_file(const std::string& path) {
  const Mapped file(path);
  Header header;
  if (!read_header(file, header)) return false;
  if (header.hybrid) return true;
  for (std::size_t at = header.end; at <= file.size(); ++at)
    if (grains_follow(file, at, header)) return true;
  return false;
}

std::optional<std::array<int, 3>> rank_grid_of(const std::string& path, int ranks) {
  const Mapped file(path);
  Header header;
  if (!read_header(file, header) || header.ranks != ranks) return std::nullopt;
  if (header.grid[0] * header.grid[1] * header.grid[2] != ranks) return std::nullopt;
  return header.grid;
}

}  // namespace suffuse::coupling
