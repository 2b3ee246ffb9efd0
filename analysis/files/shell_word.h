#pragma once

#include <string>

namespace suffuse::analysis {

/// A text as a shell takes it: quoted where it has other than letters, digits and . _ + - / = , :
std::string shell_word(const std::string& word);

}  // namespace suffuse::analysis
