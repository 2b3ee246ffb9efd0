#include "files/file_pattern.h"

#include <glob.h>

#include "suffuse/common/paths.h"

namespace suffuse::analysis {

std::vector<std::string> files_of_pattern(const std::string& pattern) {
  if (pattern.find_first_of("*?[") == std::string::npos || is_there(pattern)) return {pattern};
  std::vector<std::string> files;
  glob_t found{};
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    for (std::size_t k = 0; k < found.gl_pathc; ++k) files.emplace_back(found.gl_pathv[k]);
  globfree(&found);
  return files;
}

}  // namespace suffuse::analysis
