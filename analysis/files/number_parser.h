#pragma once

#include <cstdint>
#include <string_view>

namespace suffuse::analysis {

/// Reads a number at `at` (no leading blanks; a sign, digits, a point, an exponent; also nan and inf, as a
/// program that went wrong prints them) and returns where it ends, or nullptr where there is none. `end`: of
/// the text. The value is the nearest double, as strtod gives it.
const char* parse_number(const char* at, const char* end, double& value);

/// A whole text as a number; false where it is something else.
bool parse_number(std::string_view text, double& value);
bool parse_integer(std::string_view text, std::int64_t& value);

}  // namespace suffuse::analysis
