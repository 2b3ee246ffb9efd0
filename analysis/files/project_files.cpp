#include "files/project_files.h"

#include <cstdlib>
#include <system_error>

namespace suffuse::analysis {

namespace files = std::filesystem;

files::path program_folder() {
  std::error_code ignored;
  return files::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::vector<files::path> project_folders(const char* variable, const std::string& name,
                                         const std::string& source) {
  std::vector<files::path> folders;
  if (const char* given = std::getenv(variable)) folders.emplace_back(given);
  files::path above = program_folder();
  folders.push_back(above.parent_path() / "share/suffuse" / name);
  for (; above.has_relative_path(); above = above.parent_path()) folders.push_back(above / source);
  return folders;
}

}  // namespace suffuse::analysis
