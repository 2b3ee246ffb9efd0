#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

namespace suffuse {

/// A file of lines `variable NAME equal VALUE` for a LIGGGHTS script to include, whole or not there
/// (SafeFile); `variable NAME string none` where there is no value. Numbers with as many digits as they have.
/// Throws UserError where it cannot be written; `who` begins the message.
void write_variable_file(const std::string& path,
                         std::span<const std::pair<const char*, std::optional<double>>> variables,
                         const std::string& who);

}  // namespace suffuse
