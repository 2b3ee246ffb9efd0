#pragma once

#include <vector>

#include "declared_words.h"
#include "lbm_request.h"

namespace suffuse::coupling {

/// The lines of what happens between water and grains, and of how far that may go: `lbm solid` to `lbm
/// guard`.
std::vector<Command<LbmRequest>> commands_of_coupling();

}  // namespace suffuse::coupling
