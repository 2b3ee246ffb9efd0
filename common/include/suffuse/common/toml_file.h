#pragma once

#include <toml++/toml.h>
#include <string>

namespace suffuse {

/// Reads a TOML file. A UserError with the file and the line where it cannot be read, is no UTF-8, breaks
/// TOML's grammar, or has letters outside of ASCII anywhere but in quotes and comments, where TOML has none
/// either. `who` begins messages about the file as a whole.
toml::table read_toml(const std::string& path, const std::string& who);

}  // namespace suffuse
