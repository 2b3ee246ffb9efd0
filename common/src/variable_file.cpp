#include "suffuse/common/variable_file.h"

#include <fmt/format.h>

#include "suffuse/common/safe_file.h"

namespace suffuse {

void write_variable_file(const std::string& path, std::span<const std::pair<const char*, double>> variables,
                         const std::string& who) {
  SafeFile file(path, who);
  for (const auto& [name, value] : variables) file.write(fmt::format("variable {} equal {}\n", name, value));
  file.commit();
}

}  // namespace suffuse
