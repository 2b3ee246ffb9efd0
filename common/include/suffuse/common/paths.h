#pragma once

#include <filesystem>
#include <system_error>

namespace suffuse {

// What std::filesystem answers by throwing where a name cannot be one (too long, a loop of links) is "no"
// here.

inline bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

inline bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

}  // namespace suffuse
