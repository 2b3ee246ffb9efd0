#include "suffuse/study/placeholder.h"

namespace suffuse::study {

std::string with_value(std::string text, std::string_view placeholder, std::string_view value) {
  for (std::size_t at = 0; (at = text.find(placeholder, at)) != text.npos; at += value.size())
    text.replace(at, placeholder.size(), value);
  return text;
}

}  // namespace suffuse::study
