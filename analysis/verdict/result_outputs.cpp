#include "verdict/result_outputs.h"

#include "files/record_variables.h"

namespace suffuse::analysis {

void ResultOutputs::add_rows(CLI::App& command) {
  add(command, "--output,--csv", csv_, "CSV file with the same");
  add(command, "--json", json_, "JSON file with the same");
}

void ResultOutputs::add_variables(CLI::App& command, const std::string& description) {
  add(command, "--variables", variables_, description);
}

void ResultOutputs::write(const ResultRows& rows, const std::string& who,
                          const std::function<Record()>& variables) const {
  if (!csv_.empty()) rows.write_csv(csv_, who);
  if (!json_.empty()) rows.write_json(json_, who);
  if (!variables_.empty()) write_script_variables(variables_, variables(), who);
}

}  // namespace suffuse::analysis
