#pragma once

#include <optional>
#include <string>

namespace suffuse {

/// keep_earlier (safe_file.h) of a file that may have grown state by state: what a killed writer left half
/// written in it is taken back before. On one rank.
std::optional<std::string> keep_earlier_hdf5(const std::string& path, const std::string& who);

}  // namespace suffuse
