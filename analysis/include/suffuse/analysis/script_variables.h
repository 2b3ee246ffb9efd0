#pragma once

#include <string>
#include <vector>

namespace suffuse::analysis {

/// What a LIGGGHTS script and the files that it includes say about variables that `-var NAME VALUE` may set.
class ScriptVariables {
 public:
  /// Reads the script and, of its `include` lines, the files that are there: ${script_folder} is the script's
  /// folder, other variables in a file's name stand for any text. Throws UserError where the script cannot be
  /// read; `who` begins the message.
  ScriptVariables(const std::string& script, const std::string& who);

  /// Throws UserError where the script does not use the variable, or sets it itself in a way that -var cannot
  /// change (variable NAME equal ...).
  void require(const std::string& name, const std::string& who) const;
  /// Of the script and all that it includes: changes where any of them does (FNV-1a, 16 hexadecimal digits).
  std::string fingerprint() const;

 private:
  void read(const std::string& file);
  void note_definition(const std::string& line);
  void include(const std::string& words);

  std::string script_, folder_, text_;
  std::vector<std::string> files_, settable_, set_by_script_;
};

/// FNV-1a, 64 bits, as 16 hexadecimal digits.
std::string fingerprint_of(const std::string& text);

}  // namespace suffuse::analysis
