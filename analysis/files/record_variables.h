#pragma once

#include <string>

#include "files/record.h"

namespace suffuse::analysis {

/// The record as a file for a LIGGGHTS script to include (variable_file.h). Throws UserError
/// (`who` first) for a number that is not known, which a script could not use, unless
/// scripts take `none` for it (Entry).
void write_script_variables(const std::string& path, const Record& record, const std::string& who);

}  // namespace suffuse::analysis
