#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace suffuse {

/// How many letters must be changed, added, left out or swapped with their neighbour to make one word of the
/// other (Damerau's distance in its form with each place edited once); case does not count.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The one of `words` that `given` most likely means: the nearest within a third of its letters (at least
/// one), or the only one that it begins. Empty where nothing is near, or `given` is one of them.
std::string near_word(std::string_view given, const std::vector<std::string>& words);

/// "did you mean WORD?", or nothing.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& words);

}  // namespace suffuse
