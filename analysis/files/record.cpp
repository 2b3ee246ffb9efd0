#include "files/record.h"

#include <cstring>

namespace suffuse::analysis {

std::optional<double> value_of(const Record& record, const char* name) {
  for (const Entry& entry : record)
    if (std::strcmp(entry.name, name) == 0) return entry.value;
  return std::nullopt;
}

}  // namespace suffuse::analysis
