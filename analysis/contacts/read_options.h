#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "contacts/snapshot.h"

namespace suffuse::analysis {

/// Options of all subcommands that read snapshots of grains and contacts.
struct ReadOptions {
  std::vector<std::string> files;
  ReadSettings settings;
  std::vector<std::string> renamed;  ///< "OURS=THEIRS"
  std::string pair_values;
  std::optional<double> volume;
  std::vector<double> region;  ///< nothing, or low and high along x, y, z, m

  void add_to(CLI::App& command);
  /// With the files under another name, such as an option's, which may be missing.
  void add_to(CLI::App& command, const std::string& files_option);
  /// Opens the files. Throws UserError on options that make no sense.
  std::unique_ptr<SnapshotSeries> open();
};

/// `--split`: nothing, a diameter, or "gap".
struct SplitOption {
  std::string text;

  void add_to(CLI::App& command);
  /// None where it is not given; with "gap" from this packing.
  std::optional<double> value(const micromechanics::Packing& packing, const std::string& who) const;
};

/// 0, 1, 2 of x, y, z. Throws UserError.
int axis_of(const std::string& text, const std::string& who);

}  // namespace suffuse::analysis
