#include "files/record_variables.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "suffuse/common/error.h"
#include "suffuse/common/variable_file.h"

namespace suffuse::analysis {

void write_script_variables(const std::string& path, const Record& record, const std::string& who) {
  std::vector<std::pair<const char*, std::optional<double>>> variables;
  for (const auto& [name, value, scripts_take_none] : record) {
    if (value ? !std::isfinite(*value) : !scripts_take_none)
      throw_user_error({who, "--variables", fmt::format("no {}", name), "be a number for a script",
                        "let the run go on, or have the monitor write what it is made from"});
    variables.emplace_back(name, value);
  }
  write_variable_file(path, variables, who + " --variables");
}

}  // namespace suffuse::analysis
