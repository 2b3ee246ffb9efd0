#include "suffuse/common/variable_file.h"

#include <fmt/format.h>

#include "suffuse/common/safe_file.h"

namespace suffuse {

void write_variable_file(const std::string& path,
                         std::span<const std::pair<const char*, std::optional<double>>> variables,
                         const std::string& who) {
  SafeFile file(path, who);
  for (const auto& [name, value] : variables)
    file.write(value ? fmt::format("variable {} equal {}\n", name, *value)
                     : fmt::format("variable {} string none\n", name));
  file.commit();
}

}  // namespace suffuse
