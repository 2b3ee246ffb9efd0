#pragma once

// How a line of a script is declared: each word once, with what may follow it, where that goes and what
// readers are told of it. Reading, refusals, help, reference and completion follow from the declarations
// (lbm_words.cpp).

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "../liggghts/script_value.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/common/word_facts.h"
#include "suffuse/coupling/settings.h"

namespace suffuse::coupling {

/// Words that may follow one, and what each means, in the order in which they are listed.
template <class Meaning>
using Options = std::vector<std::pair<std::string, Meaning>>;

template <class Meaning>
std::string joined(const Options<Meaning>& options, const char* between) {
  std::string all;
  for (const auto& [word, meaning] : options) all += (all.empty() ? "" : between) + word;
  return all;
}

/// The next word by its meaning; a UserError that lists the words if it has none.
template <class Meaning>
Meaning choose(ArgumentReader& reader, const std::string& what, const Options<Meaning>& options) {
  const std::string known = joined(options, ", "), given = reader.word(what + " (" + known + ")");
  for (const auto& [word, meaning] : options)
    if (word == given) return meaning;
  throw_user_error({reader.who(), what, given, "be one of: " + known, ""});
}

/// The next word as a number in the word's range; a UserError otherwise.
double read_number(ArgumentReader& reader, const std::string& what, const NumberRange& range);

/// What the words of a run have come to.
struct SettingsOfState {
  const lbm::Units& units;
  const CoupledSettings& settings;
};

/// A word of a line whose words go into a Request.
template <class Request>
struct Word {
  using Read = std::function<void(ArgumentReader&, LAMMPS_NS::LAMMPS*, Request&)>;
  WordFacts facts;
  Read read;              ///< what follows the word
  bool required = false;  ///< for the line's form alone: `finish` refuses a line without
  bool repeats = false;   ///< may stand in a line more than once
  bool listed = false;    ///< stands for itself in a list at the line's end, as quantities of a monitor
  /// Of a word that must be the same where a saved state is taken up: what it has come to, as text, or
  /// nothing where it does not count. Empty for others.
  std::function<std::optional<std::string>(const SettingsOfState&)> kept = {};
};

/// One kind of line: `lbm NAME`.
template <class Request>
struct Command {
  std::string name, meaning;
  std::vector<Word<Request>> first = {};  ///< values that stand first, by themselves
  std::vector<Word<Request>> words = {};  ///< in any order
  std::string noun = "keyword";           ///< what messages call a word
  bool at_least_one = false;              ///< of the words must be there
  bool one_of = false;                    ///< the words are kinds of lines rather than parts of one
  std::string before = "", after = "";    ///< of the line's form: what stands before and behind the words
  /// Before the words are read, and the rules between words once they are, with the request as it was, as
  /// it will be, and the words given.
  std::function<void(ArgumentReader&, Request&)> begin = {};
  std::function<void(ArgumentReader&, const Request&, Request&, const std::set<std::string>&)> finish = {};
  /// Takes a word that no list can hold, and what follows it; false if this is none of them. `other_words`
  /// stands for them in refusals.
  std::function<bool(const std::string&, ArgumentReader&, Request&)> other = {};
  std::string other_words = "";
  bool only_before_run = false;  ///< the fluid that is there cannot change so
  bool only_resolved = false;    ///< means nothing to the averaged flow
};

/// What readers are told of a line.
struct CommandFacts {
  std::string name, meaning;
  std::string form;  ///< how the line is written
  std::vector<WordFacts> first, words;
  bool only_before_run = false, only_resolved = false;
};

std::string form_of(const WordFacts& facts, bool required);
[[noreturn]] void refuse_word(const ArgumentReader& reader, const std::string& noun, const std::string& given,
                              const std::vector<std::string>& known);

template <class Request>
CommandFacts facts_of(const Command<Request>& command) {
  CommandFacts facts{command.name, command.meaning,         "lbm " + command.name, {},
                     {},           command.only_before_run, command.only_resolved};
  const auto add = [&](const std::string& part) {
    if (!part.empty()) facts.form += " " + part;
  };
  add(command.before);
  for (const Word<Request>& word : command.first) {
    facts.first.push_back(word.facts);
    add(word.facts.value);
  }
  bool first = true;
  for (const Word<Request>& word : command.words) {
    facts.words.push_back(word.facts);
    if (word.listed) continue;
    if (command.one_of && !first) add("|");
    first = false;
    add(form_of(word.facts, word.required || command.one_of));
  }
  add(command.after);
  return facts;
}

/// Reads the words of a line. A UserError for a word that the line has not, that stands twice, or whose value
/// cannot be: the request is then as it was.
template <class Request>
void read_words(const Command<Request>& command, ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp,
                Request& request) {
  Request next = request;
  if (command.begin) command.begin(reader, next);
  for (const Word<Request>& word : command.first) word.read(reader, lmp, next);
  std::set<std::string> given;
  const auto names = [&] {
    std::vector<std::string> all;
    for (const Word<Request>& word : command.words) all.push_back(word.facts.word);
    if (!command.other_words.empty()) all.push_back(command.other_words);
    return all;
  };
  const auto read_one = [&] {
    for (const Word<Request>& word : command.words) {
      const std::string& name = word.facts.word;
      if (!(word.repeats ? reader.accept(name) : reader.keyword(name))) continue;
      word.read(reader, lmp, next);
      given.insert(name);
      return;
    }
    const std::string name = reader.word(command.noun);
    if (!command.other || !command.other(name, reader, next))
      refuse_word(reader, command.noun, name, names());
  };
  while (!reader.done()) read_one();
  if (command.at_least_one && given.empty()) refuse_word(reader, command.noun, "missing", names());
  if (command.finish) command.finish(reader, request, next, given);
  request = std::move(next);
}

/// Kinds of words. A `place` is where the value goes: a callable from Request& to a reference; what a Request
/// of its own holds there is the default.
template <class Request>
struct Declare {
  using W = Word<Request>;

  template <class Place>
  static W number(const NumberWord& n, Place place) {
    Request standard;
    return {facts_of(n, written(place(standard))),
            [n, place](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, Request& request) {
              place(request) = read_number(reader, n.word, n.range);
            }};
  }

  template <class Meaning, class Place>
  static W choice(const std::string& name, const Options<Meaning>& options, Place place,
                  const std::string& meaning) {
    Request standard;
    std::string usual;
    for (const auto& [word, value] : options)
      if (value == place(standard)) usual = word;
    return {{name, joined(options, "|"), "", "", usual, meaning},
            [name, options, place](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, Request& request) {
              place(request) = choose(reader, name, options);
            }};
  }

  /// A name or a path, `symbol` where it is listed.
  template <class Place>
  static W text(const std::string& name, const std::string& symbol, Place place, const std::string& meaning) {
    return {{name, symbol, "", "", "", meaning},
            [name, place](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, Request& request) {
              place(request) = reader.word(name);
            }};
  }

  /// Three numbers or variables.
  template <class Place>
  static W vector(const std::string& name, const std::string& unit, Place place, const std::string& meaning) {
    return {{name, "X Y Z", unit, "", "0 0 0", meaning},
            [name, place](ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, Request& request) {
              place(request) = ScriptVector::read(reader, lmp, name);
            }};
  }

  /// `auto` as well as what the word takes; `is_open`: whether a request leaves it to `auto`.
  template <class Open, class IsOpen>
  static W or_auto(W word, Open open, IsOpen is_open) {
    word.facts.value = "auto|" + word.facts.value;
    if (is_open(Request{})) word.facts.standard = "auto";
    word.read = [inner = word.read, open](ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, Request& request) {
      if (reader.accept("auto"))
        open(request);
      else
        inner(reader, lmp, request);
    };
    return word;
  }

  template <class Text>
  static W kept(W word, Text text) {
    word.kept = text;
    word.facts.kept = true;
    return word;
  }

  static W required(W word) {
    word.facts.standard.clear();
    word.required = true;
    return word;
  }

 private:
  static std::string written(double value) { return fmt::format("{:g}", value); }
  static std::string written(const std::optional<double>& value) { return value ? written(*value) : ""; }
};

}  // namespace suffuse::coupling
