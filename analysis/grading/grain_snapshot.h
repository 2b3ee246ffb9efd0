#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grading/packing_constrictions.h"

namespace suffuse::analysis {

/// The grains of one step, without contacts.
struct GrainSnapshot {
  std::int64_t step = 0;
  std::vector<Sphere> grains;
  SphereBox box;
};

/// Reads one snapshot of a LIGGGHTS `dump custom` (text or gzip) with the columns radius (or diameter) and,
/// if `positions`, x y z: the last one or that of `step`. Throws UserError (`who` first) where the file is
/// malformed, lacks a column, or has no such step or no grains.
GrainSnapshot read_grain_snapshot(const std::string& path, const std::string& who, bool positions,
                                  std::optional<std::int64_t> step = std::nullopt);

/// Diameters of the grains, m.
std::vector<double> diameters_of(const GrainSnapshot& snapshot);

}  // namespace suffuse::analysis
