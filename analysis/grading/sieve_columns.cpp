#include "grading/sieve_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <set>

#include "files/number_parser.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

using Words = std::set<std::string>;

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// `in` is the inch where it stands last or in brackets, as a unit does; elsewhere a preposition.
bool is_inch(std::string_view behind) {
  const std::size_t next = behind.find_first_not_of(" .\"'");
  return next == behind.npos || behind[next] == ')' || behind[next] == ']';
}

/// A name's words; signs become words: % percent, # no, Greek mu u, Greek phi phi.
Words words_of(const std::string& name) {
  static const std::array<std::pair<const char*, const char*>, 7> signs{{{"%", " percent "},
                                                                         {"#", " no "},
                                                                         {"\xC2\xB5", "u"},
                                                                         {"\xCE\xBC", "u"},
                                                                         {"\xB5", "u"},
                                                                         {"\xCF\x86", " phi "},
                                                                         {"\xCE\xA6", " phi "}}};
  std::string text = name;
  for (const auto& [sign, word] : signs)
    for (std::size_t at = text.find(sign); at != text.npos; at = text.find(sign, at))
      text.replace(at, std::string_view(sign).size(), word);
  Words words;
  std::string word;
  text = lowered(text) + " ";
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (std::isalnum(static_cast<unsigned char>(text[k])) != 0) {
      word += text[k];
    } else if (!word.empty()) {
      if (word != "in" || is_inch(std::string_view(text).substr(k))) words.insert(std::move(word));
      word.clear();
    }
  }
  return words;
}

bool has(const Words& words, std::initializer_list<const char*> any) {
  return std::any_of(any.begin(), any.end(), [&](const char* word) { return words.contains(word); });
}

/// To metres; none without a unit of length.
std::optional<double> length_unit(const Words& words) {
  if (has(words, {"mm", "millimetre", "millimeter", "millimetres", "millimeters"})) return 1e-3;
  if (has(words, {"um", "micron", "microns", "micrometre", "micrometer", "micrometres", "micrometers"}))
    return 1e-6;
  if (has(words, {"cm"})) return 1e-2;
  if (has(words, {"in", "inch", "inches"})) return 25.4e-3;
  if (has(words, {"m", "metre", "meter", "metres", "meters"})) return 1;
  return std::nullopt;
}

bool is_percent(const Words& words) {
  return has(words, {"percent", "percentage", "pct", "per"});
}

bool is_share(const Words& words) {
  return has(words, {"fraction", "share", "frac"});
}

bool is_mass(const Words& words) {
  return has(words, {"mass", "weight"}) || has(words, {"kg", "g", "gram", "grams"});
}

std::optional<AmountKind> amount_kind(const Words& words) {
  if (has(words, {"number", "count", "volume"})) return std::nullopt;
  if (has(words, {"finer", "passing", "passed", "undersize", "smaller"})) return AmountKind::finer;
  if (has(words, {"coarser", "oversize", "larger"})) return AmountKind::coarser;
  if (has(words, {"retained"}))
    return has(words, {"cumulative", "cum", "total"}) ? AmountKind::coarser : AmountKind::retained;
  if (has(words, {"mass", "weight"}) &&
      (is_share(words) || is_percent(words) || has(words, {"kg", "g", "gram", "grams"})))
    return AmountKind::of_class;
  return std::nullopt;
}

std::optional<SizeKind> size_kind(const Words& words) {
  if (amount_kind(words) || is_mass(words)) return std::nullopt;
  if (has(words, {"phi"})) return SizeKind::phi;
  if (has(words, {"sieve", "astm", "us"}) && has(words, {"no", "nr", "number", "astm"}) &&
      !length_unit(words))
    return SizeKind::sieve_number;
  if (has(words, {"diameter", "radius", "size", "sieve", "opening", "aperture", "d", "particle", "grain"}))
    return SizeKind::diameter;
  return std::nullopt;
}

constexpr const char* kKnownSizes =
    "have one column of sizes, such as diameter_m, diameter_mm, radius_m, sieve_mm, sieve_no or phi";
constexpr const char* kKnownAmounts =
    "have one column of amounts, such as percent_finer, percent_passing, retained_mass_g, mass_fraction or "
    "mass_kg";

[[noreturn]] void refuse_columns(const char* what, std::size_t count, const char* rule,
                                 const std::vector<std::string>& names, const std::string& path,
                                 const std::string& who) {
  throw_user_error({who, path, fmt::format("{} columns of {}", count, what), rule,
                    fmt::format("the first row has {}", fmt::join(names, ", "))});
}

/// Passing as shares is not per cent: the name tells, or the largest size.
void set_whole(const Words& words, SieveColumns& columns) {
  if (is_percent(words))
    columns.whole = 100;
  else if (is_share(words))
    columns.whole = 1;
  else
    columns.whole_by_largest = columns.amount_kind != AmountKind::of_class && !is_mass(words);
}

struct Sieve {
  std::string_view name;
  double opening_mm;
};
/// ASTM E11, Table 1.
constexpr std::array<Sieve, 52> kAstm{
    {{"4", 4.75},    {"5", 4.00},     {"6", 3.35},       {"7", 2.80},       {"8", 2.36},    {"10", 2.00},
     {"12", 1.70},   {"14", 1.40},    {"16", 1.18},      {"18", 1.00},      {"20", 0.850},  {"25", 0.710},
     {"30", 0.600},  {"35", 0.500},   {"40", 0.425},     {"45", 0.355},     {"50", 0.300},  {"60", 0.250},
     {"70", 0.212},  {"80", 0.180},   {"100", 0.150},    {"120", 0.125},    {"140", 0.106}, {"170", 0.090},
     {"200", 0.075}, {"230", 0.063},  {"270", 0.053},    {"325", 0.045},    {"400", 0.038}, {"450", 0.032},
     {"500", 0.025}, {"635", 0.020},  {"4in", 100},      {"3 1/2in", 90},   {"3in", 75},    {"2 1/2in", 63},
     {"2in", 50},    {"1 3/4in", 45}, {"1 1/2in", 37.5}, {"1 1/4in", 31.5}, {"1in", 25},    {"7/8in", 22.4},
     {"3/4in", 19},  {"5/8in", 16},   {"1/2in", 12.5},   {"7/16in", 11.2},  {"3/8in", 9.5}, {"5/16in", 8},
     {"1/4in", 6.3}, {"3 1/2", 5.6},  {"2.5in", 63},     {"1.5in", 37.5}}};

}  // namespace

SieveColumns sieve_columns(const std::vector<std::string>& names, const std::string& path,
                           const std::string& who) {
  SieveColumns columns;
  std::size_t sizes = 0, amounts = 0;
  Words size_words, amount_words;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Words words = words_of(names[k]);
    if (const auto kind = size_kind(words)) {
      const bool better = sizes == 0 || *kind < columns.size_kind;
      sizes = better ? 1 : sizes + (*kind == columns.size_kind ? 1 : 0);
      if (better) {
        columns.size = k;
        columns.size_kind = *kind;
        size_words = words;
      }
    }
    if (const auto kind = amount_kind(words)) {
      const bool better = amounts == 0 || *kind > columns.amount_kind;
      amounts = better ? 1 : amounts + (*kind == columns.amount_kind ? 1 : 0);
      if (better) {
        columns.amount = k;
        columns.amount_kind = *kind;
        amount_words = words;
      }
    }
  }
  if (sizes != 1) refuse_columns("sizes", sizes, kKnownSizes, names, path, who);
  if (amounts != 1) refuse_columns("amounts", amounts, kKnownAmounts, names, path, who);
  if (columns.size_kind == SizeKind::diameter) {
    const auto unit = length_unit(size_words);
    if (!unit)
      throw_user_error({who, path, fmt::format("column '{}'", names[columns.size]), "name its unit",
                        "as in sieve_mm, or sieve_no for ASTM numbers"});
    columns.to_diameter = *unit * (size_words.contains("radius") ? 2 : 1);
  }
  set_whole(amount_words, columns);
  if (columns.amount_kind != AmountKind::of_class && columns.amount_kind != AmountKind::retained &&
      !columns.whole && !columns.whole_by_largest)
    throw_user_error({who, path, fmt::format("column '{}'", names[columns.amount]),
                      "be in per cent or a share", "as in percent_finer"});
  // A sieve's masses lie on the sieve, even where the name does not say so.
  if (columns.amount_kind == AmountKind::of_class &&
      (size_words.contains("sieve") || columns.size_kind == SizeKind::sieve_number))
    columns.amount_kind = AmountKind::retained;
  return columns;
}

std::optional<double> astm_sieve_opening(std::string_view cell) {
  std::string name = lowered(cell);
  for (const std::string_view prefix : {"astm", "no.", "no", "#", "nr.", "nr"}) {
    if (name.starts_with(prefix)) name.erase(0, prefix.size());
    name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
  }
  for (const std::string_view inch : {"\"", " inches", " inch", " in.", " in", "inch"})
    if (name.ends_with(inch)) {
      name.erase(name.size() - inch.size());
      name += "in";
      break;
    }
  for (const Sieve& sieve : kAstm)
    if (name == sieve.name) return 1e-3 * sieve.opening_mm;
  return std::nullopt;
}

bool is_sieve_opening(double diameter) {
  return std::any_of(kAstm.begin(), kAstm.end(), [&](const Sieve& sieve) {
    return std::abs(diameter / (1e-3 * sieve.opening_mm) - 1) < 5e-3;
  });
}

bool is_pan(std::string_view cell) {
  const std::string name = lowered(cell);
  if (name == "pan" || name == "receiver" || name == "bottom" || name == "base" || name.starts_with('<'))
    return true;
  double value = 1;
  return parse_number(std::string_view(name), value) && value == 0;
}

}  // namespace suffuse::analysis
