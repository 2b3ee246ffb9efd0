#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace suffuse::analysis {

/// Options of a subcommand that name files to be written. A file that is there already is not replaced unless
/// --overwrite says so; one that is read, or written twice, never.
class OutputOptions {
 public:
  /// Adds an option for a file; with the first one also --overwrite.
  CLI::Option* add(CLI::App& command, const std::string& name, std::string& file,
                   const std::string& description);
  /// --overwrite for a subcommand whose files follow from other options.
  void add_overwrite(CLI::App& command);
  /// Throws UserError, before anything is computed, for the first file that is there, that two options name
  /// (however they spell it), or that is one of `inputs`: files that the subcommand reads, patterns of them,
  /// or nothing. `more`: files to be written that follow from other options.
  void require_new(const std::string& who, const std::vector<std::string>& inputs,
                   const std::vector<std::string>& more = {}) const;

 private:
  std::vector<std::pair<std::string, const std::string*>> files_;
  bool overwrite_ = false;
};

}  // namespace suffuse::analysis
