#include "declared_words.h"

namespace suffuse::coupling {

double read_number(ArgumentReader& reader, const std::string& what, const NumberRange& range) {
  const double value = range.least == 0 && range.above_least ? reader.positive(what) : reader.number(what);
  if (!range.holds(value))
    throw_user_error({reader.who(), what, fmt::format("{:g}", value), range.rule(), ""});
  return value;
}

std::string form_of(const WordFacts& facts, bool required) {
  const std::string form = facts.word + (facts.value.empty() ? "" : " " + facts.value);
  return required ? form : "[" + form + "]";
}

void refuse_word(const ArgumentReader& reader, const std::string& noun, const std::string& given,
                 const std::vector<std::string>& known) {
  throw_user_error(
      {reader.who(), noun, given,
       known.empty() ? "be one of: nothing more" : fmt::format("be one of: {}", fmt::join(known, ", ")), ""});
}

}  // namespace suffuse::coupling
