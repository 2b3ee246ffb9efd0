#include "suffuse/common/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>

namespace suffuse {

void throw_user_error(const InputProblem& problem) {
  std::string line =
      fmt::format("{}: {} = {}, must {}", problem.who, problem.what, problem.value, problem.rule);
  if (!problem.remedy.empty()) line += "; " + problem.remedy;
  throw UserError(line);
}

std::string refusal_of_the_machine(const std::exception& failure) {
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&failure)) {
    const std::string path = file->path1().empty() ? "." : file->path1().string();
    return fmt::format("file {}: {}", path, file->code().message());
  }
  if (const auto* system = dynamic_cast<const std::system_error*>(&failure))
    return fmt::format("a file or the screen cannot be written: {}", system->code().message());
  if (dynamic_cast<const std::bad_alloc*>(&failure) != nullptr)
    return "there is not enough memory for this input; take a part of it, or a larger machine";
  return {};
}

void require_printed_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw UserError(fmt::format("what is printed cannot be written: {}",
                              errno != 0 ? std::strerror(errno) : "output error"));
}

}  // namespace suffuse
