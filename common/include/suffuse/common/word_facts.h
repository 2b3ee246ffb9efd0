#pragma once

#include <limits>
#include <string>

namespace suffuse {

/// Which numbers a word takes.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< `least` itself is none of them
  double most = std::numeric_limits<double>::infinity();

  constexpr bool holds(double value) const {
    return (above_least ? value > least : value >= least) && value <= most;
  }
  /// "> 0", "0.001 to 60", "> 0 and at most 0.1"; empty where any number will do.
  std::string text() const;
  /// As InputProblem::rule.
  std::string rule() const { return "be " + text(); }
};

inline constexpr NumberRange kPositive{0, true};
inline constexpr NumberRange kNotNegative{0, false};
constexpr NumberRange positive_up_to(double most) {
  return {0, true, most};
}
constexpr NumberRange between(double least, double most) {
  return {least, false, most};
}

/// A word that one number follows, wherever it stands: in a line of a script or in a file.
struct NumberWord {
  const char* word;
  const char* symbol;  ///< stands for the number where the word is listed
  const char* unit;    ///< SI; empty for none
  NumberRange range;
  const char* meaning;
};

/// What readers are told of a word: help, reference and completion are made from it.
struct WordFacts {
  std::string word;      ///< for what stands first in its line by itself: how messages call it
  std::string value;     ///< how what follows is written: "RHO", "yes|no", "FILE [every T]"; empty: nothing
  std::string unit;      ///< SI; empty for none
  std::string range;     ///< NumberRange::text
  std::string standard;  ///< what it is where the word is not given, as it would be written; empty: nothing
  std::string meaning;   ///< one line
  bool kept = false;     ///< must be the same where a saved state is taken up
};

WordFacts facts_of(const NumberWord& word, const std::string& standard);

/// What a program's `--words` prints, tab-separated, for scripts/reference_tables: titles, and a row a word.
/// `line` is where the word stands, `place` whether that is anywhere in it ("any"), first, or the line itself
/// ("line": its form and meaning).
inline constexpr const char* kWordTitles = "line\tplace\tword\tvalue\tunit\trange\tdefault\tkept\tmeaning\n";
std::string word_row(const std::string& line, const char* place, const WordFacts& word);

}  // namespace suffuse
