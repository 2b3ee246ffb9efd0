#pragma once

#include <map>
#include <string>
#include <vector>

namespace suffuse {

/// What a LIGGGHTS script and the files that it includes say about variables that `-var NAME VALUE` may set.
class ScriptVariables {
 public:
  /// Reads the script and, of its `include` lines, the files that are there: ${script_folder} is the script's
  /// folder, variables in a folder's name have their value of `given` (-var) or the first of their `index`
  /// line, and those in a file's name stand for any text. Throws UserError where the script cannot be read;
  /// `who` begins the message.
  ScriptVariables(const std::string& script, const std::string& who,
                  const std::map<std::string, std::string>& given = {});

  /// Throws UserError where the script does not use the variable, or sets it itself in a way that -var cannot
  /// change (variable NAME equal ...).
  void require(const std::string& name, const std::string& who) const;
  /// May -var NAME change anything? No, where all that is included was found and the name stands nowhere,
  /// neither used nor set, or only in files of another choice (scale_own.inc of scale_${scale}.inc, with
  /// scale = quick by -var, or by a line `variable scale index quick` at the head of the script, before
  /// anything but such lines and comments).
  bool reads(const std::string& name) const;
  /// Throws UserError where it may not. Names the choice that reads it, or the nearest of those that -var can
  /// set.
  void require_known(const std::string& name, const std::string& who) const;
  /// Throws UserError where the variable's value is part of the name of an included file of the script's own
  /// folders (`include ${script_folder}/scale_${scale}.inc`) and no such file is there, nor made by the
  /// script; names those that are.
  void require_choice(const std::string& name, const std::string& value, const std::string& who) const;
  /// Throws UserError where two variables are given of which one stands for the other: a line of the script
  ///   # -var NAME takes the place of OTHER, OTHER
  /// says so. NAME given as `none` takes no place.
  void require_no_two_for_one(const std::map<std::string, std::string>& given, const std::string& who) const;
  /// Of the script and all that it includes: changes where any of them does (FNV-1a, 16 hexadecimal digits).
  std::string fingerprint() const;

 private:
  /// Values of variables with which a file is included.
  using Choices = std::map<std::string, std::string>;

  void read(const std::string& file, const Choices& under);
  void note_head();
  void note_definition(const std::string& line);
  void include(const std::string& words, bool always, const Choices& under);
  std::string folder_of(const std::string& name) const;
  std::vector<std::string> unmet(const Choices& choices) const;
  bool changes(const std::string& name) const;
  std::vector<std::string> choices_that_read(const std::string& name) const;

  std::string script_, folder_, text_;
  std::vector<std::string> settable_, set_by_script_;
  std::map<std::string, std::string> texts_;          ///< of each file that was read
  std::map<std::string, std::vector<Choices>> ways_;  ///< with which each of them is included
  std::map<std::string, std::string> values_;         ///< of variables in folders' names
  Choices certain_;  ///< values of choices that no line of the script can change
  /// All that `index` lines give a variable, or -var; an `include ${name}` may be any of these.
  std::map<std::string, std::vector<std::string>> offered_;
  std::map<std::string, std::vector<std::string>> choices_;  ///< of variables in files' names
  std::map<std::string, std::string> included_as_;           ///< such a file's name, variable and all
  bool all_found_ = true;  ///< no file is included from a folder that is not known
};

/// FNV-1a, 64 bits, as 16 hexadecimal digits.
std::string fingerprint_of(const std::string& text);

}  // namespace suffuse
