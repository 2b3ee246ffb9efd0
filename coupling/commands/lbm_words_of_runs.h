#pragma once

#include <vector>

#include "declared_words.h"
#include "lbm_request.h"

namespace suffuse::coupling {

/// Words after the ID of a `lbm monitor` and of a `lbm output`.
const Command<MonitorRequest>& monitor_command();
const Command<OutputRequest>& output_command();

/// The lines of what is written while a run goes, and those that ask for something at once: `lbm monitor` to
/// `lbm clear`.
std::vector<CommandFacts> commands_of_runs();

}  // namespace suffuse::coupling
