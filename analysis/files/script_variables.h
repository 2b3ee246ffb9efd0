#pragma once

#include <string>

#include "files/record.h"

namespace suffuse::analysis {

/// A line `variable NAME equal VALUE` for each number, for a LIGGGHTS script to include. Throws UserError
/// (`who` first) for a number that is not known, which a script could not use.
void write_script_variables(const std::string& path, const Record& record, const std::string& who);

}  // namespace suffuse::analysis
