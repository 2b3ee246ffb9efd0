#pragma once

#include <string>
#include <vector>

namespace suffuse::analysis {

/// The files that a name or a shell pattern (* ? [ ]) stands for, in the order of glob(3). A name without
/// pattern, or of something that is there, is itself; a pattern that nothing matches stands for no file.
std::vector<std::string> files_of_pattern(const std::string& pattern);

}  // namespace suffuse::analysis
