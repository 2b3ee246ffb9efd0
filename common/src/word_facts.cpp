#include "suffuse/common/word_facts.h"

#include <fmt/format.h>

#include <cmath>

namespace suffuse {

std::string NumberRange::text() const {
  constexpr double absurd = 1e300;  // a bound that keeps arithmetic finite says nothing to a reader
  const bool low = std::isfinite(least), high = most < absurd;
  if (low && high && !above_least) return fmt::format("{:g} to {:g}", least, most);
  std::string both = low ? fmt::format("{} {:g}", above_least ? ">" : ">=", least) : "";
  if (high) both += fmt::format("{}at most {:g}", low ? " and " : "", most);
  return both;
}

WordFacts facts_of(const NumberWord& word, const std::string& standard) {
  return {word.word, word.symbol, word.unit, word.range.text(), standard, word.meaning};
}

std::string word_row(const std::string& line, const char* place, const WordFacts& word) {
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", line, place, word.word, word.value, word.unit,
                     word.range, word.standard, word.kept ? "kept" : "", word.meaning);
}

}  // namespace suffuse
