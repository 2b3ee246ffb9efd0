#include "files/output_options.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "files/file_pattern.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/safe_file.h"

namespace suffuse::analysis {
namespace {

void refuse_if_there(const std::string& who, const std::string& option, const std::string& file) {
  std::error_code ignored;  // a name that cannot be looked up is told where it is opened
  const bool empty_folder = is_folder(file) && std::filesystem::is_empty(file, ignored);
  if (!file.empty() && !empty_folder && is_there(file))
    throw_user_error({who, option, file, "not be there yet",
                      "give another name, or --overwrite to replace what is there"});
}

/// A file that is written, and by which option.
struct Output {
  std::string option, file;
};

/// Under which names a file is written: its own, and SafeFile's until it is complete.
std::vector<std::string> names_while_written(const std::string& file) {
  return {one_name_of(file), one_name_of(file + ".part")};
}

void refuse_one_file_twice(const std::string& who, const std::vector<Output>& outputs) {
  std::map<std::string, const Output*> written;
  for (const Output& output : outputs)
    for (const std::string& name : names_while_written(output.file))
      if (const auto [at, is_new] = written.emplace(name, &output); !is_new)
        throw_user_error({who, output.option, output.file,
                          fmt::format("be another file than that of {}", at->second->option),
                          "one would replace the other"});
}

void refuse_inputs(const std::string& who, const std::vector<Output>& outputs,
                   const std::vector<std::string>& inputs) {
  std::set<std::string> read;
  for (const std::string& input : inputs)
    for (const std::string& file : files_of_pattern(input))
      if (is_file(file)) read.insert(one_name_of(file));
  for (const Output& output : outputs)
    for (const std::string& name : names_while_written(output.file))
      if (read.contains(name))
        throw_user_error(
            {who, output.option, output.file, "not be a file that is read", "give another name"});
}

}  // namespace

void OutputOptions::add_overwrite(CLI::App& command) {
  command.add_flag("--overwrite", overwrite_, "replace files of earlier results");
}

CLI::Option* OutputOptions::add(CLI::App& command, const std::string& name, std::string& file,
                                const std::string& description) {
  if (files_.empty()) add_overwrite(command);
  files_.emplace_back(name, &file);
  return command.add_option(name, file, description);
}

void OutputOptions::require_new(const std::string& who, const std::vector<std::string>& inputs,
                                const std::vector<std::string>& more) const {
  std::vector<Output> outputs;
  for (const auto& [option, file] : files_)
    if (!file->empty()) outputs.push_back({option, *file});
  for (const std::string& file : more) outputs.push_back({"file", file});
  refuse_one_file_twice(who, outputs);
  refuse_inputs(who, outputs, inputs);
  if (overwrite_) return;
  for (const Output& output : outputs) refuse_if_there(who, output.option, output.file);
}

}  // namespace suffuse::analysis
