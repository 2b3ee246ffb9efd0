#pragma once

#include <vector>

#include "declared_words.h"
#include "lbm_request.h"

namespace suffuse::coupling {

/// The lines that say what the water is like and what drives it: `lbm method` to `lbm collision`.
std::vector<Command<LbmRequest>> commands_of_water();

}  // namespace suffuse::coupling
