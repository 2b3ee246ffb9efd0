#include "suffuse/study/study_launcher.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "files/project_files.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/study/placeholder.h"

namespace suffuse::study {
namespace {

namespace files = std::filesystem;

constexpr const char* kRanks = "{ranks}";

bool can_run(const files::path& path) {
  return is_file(path) && access(path.c_str(), X_OK) == 0;
}

bool is_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (can_run(files::path(folder) / name)) return true;
  return false;
}

/// scripts/mpirun of the source tree above the program, or suffuse-mpirun beside an installed one.
std::string own_mpirun() {
  const files::path folder = analysis::program_folder();
  if (can_run(folder / "suffuse-mpirun")) return (folder / "suffuse-mpirun").string();
  for (files::path above = folder; above.has_relative_path(); above = above.parent_path())
    if (can_run(above / "scripts/mpirun")) return (above / "scripts/mpirun").string();
  return "";
}

}  // namespace

StudyLauncher::StudyLauncher(const std::string& text, const std::string& folder, const std::string& who,
                             const std::string& what) {
  std::istringstream stream(text);
  words_.assign(std::istream_iterator<std::string>(stream), {});
  if (text.find(kRanks) == text.npos)
    throw_user_error({who, what, text, "have {ranks} where the number of ranks stands",
                      "\"srun --exact -n {ranks}\" or \"mpirun -np {ranks}\""});
  std::string& program = words_.front();
  const bool has_folder = program.find('/') != program.npos;
  if (has_folder) program = (files::absolute(folder) / program).lexically_normal().string();
  if (has_folder ? !can_run(program) : !is_on_path(program))
    throw_user_error({who, what, program, "be a program that can be run", ""});
}

std::vector<std::string> StudyLauncher::words(int ranks) const {
  const std::string number = std::to_string(ranks);
  if (words_.empty() && ranks == 1) return {};
  if (words_.empty()) {
    const std::string own = own_mpirun();
    return own.empty() ? std::vector<std::string>{"mpirun", "-np", number}
                       : std::vector<std::string>{own, number};
  }
  std::vector<std::string> words = words_;
  for (std::string& word : words) word = with_value(std::move(word), kRanks, number);
  return words;
}

bool StudyLauncher::is_srun() const {
  return !words_.empty() && files::path(words_.front()).filename() == "srun";
}

}  // namespace suffuse::study
