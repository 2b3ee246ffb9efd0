#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace suffuse::analysis {

/// The folder of the program that runs; empty without /proc.
std::filesystem::path program_folder();

/// Where files of the project may lie: in the folder that an environment variable names, in
/// share/suffuse/NAME of the installation, and in SOURCE of the source trees above the program.
std::vector<std::filesystem::path> project_folders(const char* variable, const std::string& name,
                                                   const std::string& source);

}  // namespace suffuse::analysis
