#pragma once

// What the programs of this folder share: the bytes as numbers, as a file, and what may be thrown.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "suffuse/common/error.h"

namespace suffuse::fuzz {

/// Takes decisions from the bytes of an input, one after the other; zeros once they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return at_ >= size_; }
  std::uint8_t next() { return empty() ? std::uint8_t{0} : data_[at_++]; }
  /// 0 to most − 1.
  int below(int most) { return next() % most; }
  /// Values that readers trip over: small and huge, negative, not numbers.
  double number() {
    static constexpr double kOdd[] = {0,      1,    -1,    0.5,  1e-4,  2,    1e300, -1e300,
                                      1e-300, 1e18, -1e18, 2e31, 9.5e9, 4e18, 1e-12, 3};
    switch (below(4)) {
      case 0:
        return below(256);
      case 1:
        return kOdd[below(16)];
      case 2:
        return 1e-4 * below(256);
      default:
        switch (below(3)) {
          case 0:
            return std::strtod("nan", nullptr);
          case 1:
            return -std::strtod("inf", nullptr);
          default:
            return std::strtod("inf", nullptr);
        }
    }
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

/// Names of files in a folder of this process, in memory where there is such a disk; removed at its end.
class Folder {
 public:
  Folder() {
    const std::filesystem::path memory = "/dev/shm";
    const auto parent =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    path_ = parent / ("suffuse-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string file(const std::string& name, std::string_view text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

inline Folder& folder() {
  static Folder one;
  return one;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Runs a reader. It may refuse the input (UserError); anything else that it throws ends the program.
template <class Work>
int refused_or_read(Work&& work) {
  try {
    work();
  } catch (const UserError&) {
  }
  return 0;
}

}  // namespace suffuse::fuzz

extern "C" {
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
}
