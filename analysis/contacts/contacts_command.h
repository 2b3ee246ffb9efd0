#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse contacts FILES...`: coordination, stress reduction, sliding, fabric and force network of
/// every snapshot.
void add_contacts(CLI::App& app);

}  // namespace suffuse::analysis
