#include "contacts/contact_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "files/number_parser.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

const std::vector<std::string> kContactNames{
    "x1",          "y1",  "z1",  "x2",  "y2",  "z2",  "id1", "id2",   "fx",       "fy",
    "fz",          "fnx", "fny", "fnz", "ftx", "fty", "ftz", "delta", "friction", "friction_limit",
    "spring_force"};
const std::vector<std::string> kGrainNames{"id", "radius", "diameter", "x", "y", "z"};

struct PairWord {
  const char* word;
  std::vector<std::string> names;  ///< one a value; empty: not used
};

/// In LIGGGHTS's order (compute_pair_gran_local.cpp, add_pair).
const std::vector<PairWord>& pair_words() {
  static const std::vector<PairWord> words{
      {"pos", {"x1", "y1", "z1", "x2", "y2", "z2"}},
      {"vel", {"", "", "", "", "", ""}},
      {"id", {"id1", "id2", ""}},
      {"force", {"fx", "fy", "fz"}},
      {"force_normal", {"fnx", "fny", "fnz"}},
      {"force_tangential", {"ftx", "fty", "ftz"}},
      {"torque", {"", "", ""}},
      {"torque_normal", {"", "", ""}},
      {"torque_tangential", {"", "", ""}},
      {"history", {}},  // as many as the contact law has; nothing behind it can be told
      {"contactArea", {""}},
      {"delta", {"delta"}},
      {"heatFlux", {""}},
      {"contactPoint", {"", "", ""}},
      {"ms_id", {"", ""}},
  };
  return words;
}

/// The k of a column NAME[k] of a compute, or 0.
std::int64_t number_of_value(const std::string& column) {
  const std::size_t bracket = column.find('[');
  std::int64_t k = 0;
  if (!column.starts_with("c_") || bracket == std::string::npos || !column.ends_with(']')) return 0;
  const std::string_view inside(column.data() + bracket + 1, column.size() - bracket - 2);
  return parse_integer(inside, k) ? k : 0;
}

std::vector<std::string> guessed_words(const std::vector<std::string>& columns) {
  std::int64_t most = 0;
  for (const std::string& column : columns) most = std::max(most, number_of_value(column));
  std::vector<std::string> words{"pos", "id", "force"};
  if (most >= 15) words.emplace_back("force_normal");
  if (most >= 18) words.emplace_back("force_tangential");
  return words;
}

ColumnPlan plan(const std::vector<std::string>& meanings, const std::vector<std::string>& names) {
  ColumnPlan result{std::vector<int>(meanings.size(), -1), std::vector<bool>(names.size(), false)};
  for (std::size_t column = 0; column < meanings.size(); ++column) {
    const auto found = std::find(names.begin(), names.end(), meanings[column]);
    if (found == names.end()) continue;
    const auto place = static_cast<std::size_t>(found - names.begin());
    if (result.has[place]) continue;  // a column that is there twice: the first counts
    result.has[place] = true;
    result.place_of_column[column] = static_cast<int>(place);
  }
  return result;
}

/// Our names for the columns that the user named.
void apply_renames(std::vector<std::string>& meanings, const std::vector<std::string>& columns,
                   const std::map<std::string, std::string>& renamed, const std::vector<std::string>& names,
                   const char* dump, const std::string& who) {
  for (const auto& [ours, theirs] : renamed) {
    if (std::find(names.begin(), names.end(), ours) == names.end()) continue;
    if (std::find(columns.begin(), columns.end(), theirs) == columns.end())
      throw_user_error({who, fmt::format("--column {} of the dump of {}", ours, dump), theirs,
                        fmt::format("be one of {}", fmt::join(columns, ", ")), ""});
    std::replace(meanings.begin(), meanings.end(), ours, std::string());
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k] == theirs) meanings[k] = ours;
  }
}

}  // namespace

std::vector<std::string> known_columns() {
  std::vector<std::string> names = kContactNames;
  names.insert(names.end(), kGrainNames.begin(), kGrainNames.end());
  return names;
}

bool ColumnPlan::has_vector(int first) const {
  const auto at = static_cast<std::size_t>(first);
  return has[at] && has[at + 1] && has[at + 2];
}

std::vector<std::string> names_of_pair_values(const std::vector<std::string>& words, const std::string& who) {
  for (const std::string& word : words)
    if (std::none_of(pair_words().begin(), pair_words().end(),
                     [&](const PairWord& w) { return w.word == word; }))
      throw_user_error({who, "--pair-values", word, "be a word of LIGGGHTS's compute pair/gran/local",
                        "repeat the words of your script: pos id force force_normal force_tangential …"});
  std::vector<std::string> names;
  for (const PairWord& known : pair_words()) {
    if (std::find(words.begin(), words.end(), known.word) == words.end()) continue;
    if (known.names.empty()) break;
    names.insert(names.end(), known.names.begin(), known.names.end());
  }
  return names;
}

ColumnPlan plan_contact_columns(const std::vector<std::string>& columns,
                                const std::vector<std::string>& words,
                                const std::map<std::string, std::string>& renamed, const std::string& who) {
  const std::vector<std::string> values =
      names_of_pair_values(words.empty() ? guessed_words(columns) : words, who);
  std::vector<std::string> meanings;
  for (const std::string& column : columns) {
    const auto k = static_cast<std::size_t>(number_of_value(column));
    meanings.push_back(k == 0 ? column : k <= values.size() ? values[k - 1] : "");
  }
  apply_renames(meanings, columns, renamed, kContactNames, "contacts", who);
  return plan(meanings, kContactNames);
}

ColumnPlan plan_grain_columns(const std::vector<std::string>& columns,
                              const std::map<std::string, std::string>& renamed, const std::string& who) {
  std::vector<std::string> meanings = columns;
  apply_renames(meanings, columns, renamed, kGrainNames, "grains", who);
  return plan(meanings, kGrainNames);
}

}  // namespace suffuse::analysis
