#include "files/script_variables.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"

namespace suffuse::analysis {

void write_script_variables(const std::string& path, const Record& record, const std::string& who) {
  std::string text;
  for (const auto& [name, value] : record) {
    if (!value || !std::isfinite(*value))
      throw_user_error({who, "--variables", fmt::format("no {}", name), "be a number for a script",
                        "let the run go on, or have the monitor write what it is made from"});
    text += fmt::format("variable {} equal {:.10g}\n", name, *value);
  }
  SafeFile file(path, who + " --variables");
  file.write(text);
  file.commit();
}

}  // namespace suffuse::analysis
