#pragma once

#include <CLI/App.hpp>

namespace suffuse::analysis {

/// `suffuse-analyse rose FILES...`: orientation of contacts and forces in a plane and over the sphere.
void add_rose(CLI::App& app);

}  // namespace suffuse::analysis
