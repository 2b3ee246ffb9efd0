#pragma once

#include <array>
#include <optional>
#include <string>

namespace suffuse::coupling {

/// Is a file that LIGGGHTS's `write_restart` made whole? Its header is read (flags and values, as
/// LIGGGHTS 3.8 writes them), and its end must be the grains of as many ranks as the header says, each grain
/// a record that begins with its own length. What lies between depends on styles and is not looked at. True
/// for `atom_style hybrid`, whose header has more than flags and values.
bool is_whole_restart_file(const std::string& path);

/// How the box was shared among ranks along x, y, z when a restart file was written; none if it was written
/// on another number of ranks.
std::optional<std::array<int, 3>> rank_grid_of(const std::string& path, int ranks);

}  // namespace suffuse::coupling
