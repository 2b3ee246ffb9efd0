#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sphere_cut.h"

namespace suffuse::analysis {

/// What a region's sample is a part of.
struct WholePacking {
  micromechanics::Packing packing;
  std::vector<bool> is_in_part;  ///< of each grain; those of the part are in the same order
};

/// Grains and contacts of one step of a run. All grains are owned; all contacts count whole but those with a
/// grain outside of a region (micromechanics::part_inside).
struct Snapshot {
  std::int64_t step = 0;
  std::optional<double> time;  ///< s, where the file tells it
  micromechanics::Packing packing;
  std::optional<WholePacking> whole;  ///< of which `packing` is the part in the region, if one is given
  bool six_digits = false;  ///< from text of six digits, LIGGGHTS's default, so that forces are rounded
};

/// How files are read.
struct ReadSettings {
  std::string who = "contacts";  ///< begins the messages
  /// Words of the script's `compute pair/gran/local`, which say what c_ID[1], c_ID[2], … are; empty: guessed
  /// from how many there are (`pos id force force_normal force_tangential`, as far as they reach).
  std::vector<std::string> contact_words;
  /// Our name of a quantity → its column in the file, where that differs.
  std::map<std::string, std::string> columns;
  double friction = 0.3;  ///< of all contacts, where the file does not tell it
  /// Of the sample, m³; the box's where neither this nor the next two are given.
  std::optional<double> volume;
  bool bed = false;                           ///< the sample is the bed (micromechanics::bed_box)
  std::optional<micromechanics::Box> region;  ///< the sample is what lies in it, m
};

/// Snapshots in the order of their steps; one is in memory at a time.
class SnapshotSeries {
 public:
  virtual ~SnapshotSeries() = default;

  /// False after the last one. Throws UserError on malformed files.
  virtual bool next(Snapshot& snapshot) = 0;
  /// Share of the bytes that have been read, 0 to 1.
  virtual double done() const = 0;
  virtual std::int64_t bytes() const = 0;
  /// What was left out on the way, and whether the box is another body than the bed, for people; empty if
  /// nothing.
  virtual std::string notes() const { return {}; }
};

/// Opens dumps of grains and contacts (any mix of files and of patterns with * or ?; one snapshot a file or
/// many; put into order by their first step) or one of our HDF5 files. Throws UserError where a file cannot
/// be read, is neither, or where grains or contacts are missing.
std::unique_ptr<SnapshotSeries> open_series(const std::vector<std::string>& files,
                                            const ReadSettings& settings);

}  // namespace suffuse::analysis
