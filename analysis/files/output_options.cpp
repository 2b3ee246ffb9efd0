#include "files/output_options.h"

#include <filesystem>
#include <system_error>

#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"

namespace suffuse::analysis {
namespace {

void refuse_if_there(const std::string& who, const std::string& option, const std::string& file) {
  std::error_code ignored;  // a name that cannot be looked up is told where it is opened
  const bool empty_folder = is_folder(file) && std::filesystem::is_empty(file, ignored);
  if (!file.empty() && !empty_folder && is_there(file))
    throw_user_error({who, option, file, "not be there yet",
                      "give another name, or --overwrite to replace what is there"});
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

void OutputOptions::require_new(const std::string& who, const std::vector<std::string>& more) const {
  if (overwrite_) return;
  for (const auto& [option, file] : files_) refuse_if_there(who, option, *file);
  for (const std::string& file : more) refuse_if_there(who, "file", file);
}

}  // namespace suffuse::analysis
