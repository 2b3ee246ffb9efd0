#include "suffuse/common/error.h"

#include <fmt/format.h>

namespace suffuse {

void throw_user_error(const InputProblem& problem) {
  std::string line =
      fmt::format("{}: {} = {}, must {}", problem.who, problem.what, problem.value, problem.rule);
  if (!problem.remedy.empty()) line += "; " + problem.remedy;
  throw UserError(line);
}

}  // namespace suffuse
