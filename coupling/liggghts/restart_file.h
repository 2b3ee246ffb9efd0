#pragma once

#include <string>

namespace suffuse::coupling {

/// Is a file that LIGGGHTS's `write_restart` made whole? Its header is read (flags and values, as
/// LIGGGHTS 3.8 writes them), and its end must be the grains of as many ranks as the header says, each grain
/// a record that begins with its own length. What lies between depends on styles and is not looked at. True
/// for `atom_style hybrid`, whose header has more than flags and values.
bool is_whole_restart_file(const std::string& path);

}  // namespace suffuse::coupling
