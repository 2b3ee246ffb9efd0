#include "files/figure_script.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "files/project_files.h"
#include "files/shell_word.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"

namespace suffuse::analysis {
namespace {

namespace files = std::filesystem;

/// Exit code of a program with these arguments; 127 where it cannot be started.
int run(const std::vector<std::string>& words, bool silent) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) return 127;
  if (child == 0) {
    if (silent) {
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
    }
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 127;
}

std::string find_script(const std::string& script, const std::string& who) {
  for (const files::path& folder : project_folders("SUFFUSE_FIGURES", "figures", "analysis/figures"))
    if (is_file(folder / script)) return (folder / script).string();
  throw_user_error({who, "figure", script, "find the script",
                    "set SUFFUSE_FIGURES to the folder share/suffuse/figures of the installation"});
}

}  // namespace

namespace {

/// Looked for once: trying out matplotlib takes half a second.
std::string find_python(const std::string& who) {
  static std::string found;
  if (!found.empty()) return found;
  std::vector<std::string> candidates{"python3", "/usr/bin/python3"};
  if (const char* given = std::getenv("SUFFUSE_PYTHON")) candidates.insert(candidates.begin(), given);
  for (const std::string& python : candidates)
    if (run({python, "-c", "import matplotlib"}, true) == 0) return found = python;
  throw_user_error({who, "figure", "python3", "have matplotlib",
                    "install it (apt-get install python3-matplotlib), or name a Python in SUFFUSE_PYTHON"});
}

}  // namespace

std::string figure_script_as_called(const std::string& script, const std::string& who) {
  const std::string found = find_script(script, who);
  // Of a source tree the path within it, from an installation the whole one.
  const std::string path =
      found.ends_with("/analysis/figures/" + script) ? "analysis/figures/" + script : found;
  const std::string python = find_python(who);
  return (python == "python3" ? "" : shell_word(python) + " ") + shell_word(path);
}

void make_figure(const std::string& script, const std::vector<std::string>& arguments,
                 const std::string& who) {
  std::vector<std::string> words{find_python(who), find_script(script, who)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (const int code = run(words, false); code != 0)
    throw_user_error({who, "figure", script, "be drawn", "the script's own message stands above"});
}

}  // namespace suffuse::analysis
