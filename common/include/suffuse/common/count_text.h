#pragma once

#include <cstdint>
#include <string>

namespace suffuse {

/// "1 grain", "2 grains": for nouns that take an s.
inline std::string count_text(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace suffuse
