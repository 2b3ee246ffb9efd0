#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace suffuse::analysis {

/// The sign between a number's units and its tenths; the other one then groups thousands.
enum class DecimalMark { point, comma };

/// Which one a file uses, from all of its numbers: "0,5" or "1.250,5" can only have a comma, "4.75" or
/// "1,250.5" only a point; "1,250" may be either. Throws UserError (`who` first) where the numbers contradict
/// each other, and where none decides: "1,250", and with cells separated by semicolons "1.250" too, may
/// be 1.25 or 1250.
DecimalMark decimal_mark_of(const std::vector<std::string>& numbers, char separator, const std::string& who);

/// A number with that mark, with or without groups of three digits (by the other mark, a blank or an
/// apostrophe) and a sign of per cent at its end; none where the text is something else or not finite.
std::optional<double> parse_decimal(std::string_view text, DecimalMark mark);

}  // namespace suffuse::analysis
