#pragma once

#include <optional>
#include <string>
#include <vector>

namespace suffuse::analysis {

/// A folder with a simulated sample, as its file sample.toml describes it:
///
///     table_4_1 = "8b"                 # its name in the thesis's tables; one of both at least
///     table_5_1 = "A(30%)"
///     state = "dense"                  # loose, medium or dense; or:
///     friction_compression = 0         # 0.3 loose, 0.1 medium, 0 dense (thesis section 4.3)
///     split_m = 0.3e-3                 # fines are smaller, m; left out: in the gap of the sizes
///     friction = 0.3                   # of the contacts in the dumps; left out: 0.3
///     grains = "grains.dump"           # file or pattern; left out: *grains*.dump*
///     contacts = "contacts.dump"       # left out: *contacts*.dump*
///     youngs_modulus_pa = 70e9         # left out: not told in the table
struct SampleFolder {
  std::string folder;
  std::string table_4_1, table_5_1;  ///< empty: not in that table
  std::string state;
  std::optional<double> split;  ///< m
  double friction = 0.3;
  std::string grains, contacts;          ///< with the folder
  std::optional<double> youngs_modulus;  ///< Pa
};

/// Reads FOLDER/sample.toml. Throws UserError (`who` first) on what it does not understand.
SampleFolder read_sample_folder(const std::string& folder, const std::string& who);

/// All folders with a sample.toml in or below the roots, each once, sorted. Throws UserError where a root is
/// no folder.
std::vector<std::string> find_sample_folders(const std::vector<std::string>& roots, const std::string& who);

}  // namespace suffuse::analysis
