#pragma once

#include <functional>
#include <string>

#include "files/output_options.h"
#include "files/record.h"
#include "verdict/result_rows.h"

namespace suffuse::analysis {

/// Output options of a subcommand whose results are rows.
class ResultOutputs : public OutputOptions {
 public:
  /// --output (--csv) and --json.
  void add_rows(CLI::App& command);
  /// --variables, of what `write` is told.
  void add_variables(CLI::App& command, const std::string& description);
  /// The files that were asked for; `variables` is called for those of a script alone.
  void write(const ResultRows& rows, const std::string& who,
             const std::function<Record()>& variables = {}) const;

 private:
  std::string csv_, json_, variables_;
};

}  // namespace suffuse::analysis
