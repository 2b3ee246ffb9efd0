#include "suffuse/common/near_word.h"

#include <algorithm>
#include <cctype>

namespace suffuse {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  };
  std::vector<std::size_t> before, last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0U : 1U)});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

std::string near_word(std::string_view given, const std::vector<std::string>& words) {
  if (given.empty() || std::find(words.begin(), words.end(), given) != words.end()) return {};
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, given.size() / 3) + 1;
  for (const std::string& word : words) {
    // A word of one or two letters is near everything.
    const std::size_t distance = edit_distance(given, word);
    if (distance >= least || distance >= std::max(word.size(), given.size())) continue;
    least = distance;
    nearest = word;
  }
  if (!nearest.empty() || given.size() < 3) return nearest;
  const auto begun = [&](const std::string& word) { return word.starts_with(given); };
  if (std::count_if(words.begin(), words.end(), begun) != 1) return {};
  return *std::find_if(words.begin(), words.end(), begun);
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& words) {
  const std::string nearest = near_word(given, words);
  return nearest.empty() ? "" : "did you mean " + nearest + "?";
}

}  // namespace suffuse
