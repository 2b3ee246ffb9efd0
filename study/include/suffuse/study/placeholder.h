#pragma once

#include <string>
#include <string_view>

namespace suffuse::study {

/// A text with every `placeholder`, {study} or {ranks} say, replaced by what it stands for.
std::string with_value(std::string text, std::string_view placeholder, std::string_view value);

}  // namespace suffuse::study
