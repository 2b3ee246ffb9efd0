#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::analysis {

struct Sphere {
  Vec3 centre = Vec3::Zero();  ///< m
  double radius = 0;           ///< m
};

/// Finds the grains that reach into a place. One grid for each octave of sizes, so that a few large grains do
/// not make the search among many small ones slow.
class SphereGrid {
 public:
  explicit SphereGrid(std::span<const Sphere> spheres) : spheres_(spheres) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const int octave = static_cast<int>(std::ceil(std::log2(spheres[i].radius)));
      Level& level = levels_.try_emplace(octave, Level{std::exp2(octave + 1), {}}).first->second;
      level.cells[key(cell_of(spheres[i].centre, level.cell))].push_back(i);
    }
  }

  /// Calls take(index) for every sphere that overlaps the one given, and possibly for a few near it.
  template <class Take>
  void near(const Vec3& centre, double radius, Take&& take) const {
    for (const auto& [octave, level] : levels_) {
      const Vec3 reach =
          Vec3::Constant(radius + level.cell / 2);  // level.cell: twice the level's largest radius
      const Cell low = cell_of(centre - reach, level.cell), high = cell_of(centre + reach, level.cell);
      for (std::int64_t x = low.x; x <= high.x; ++x)
        for (std::int64_t y = low.y; y <= high.y; ++y)
          for (std::int64_t z = low.z; z <= high.z; ++z)
            if (const auto found = level.cells.find(key({x, y, z})); found != level.cells.end())
              for (const std::size_t i : found->second) take(i);
    }
  }

 private:
  struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
  };
  struct Level {
    double cell = 0;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  };

  static Cell cell_of(const Vec3& point, double size) {
    const auto along = [&](double x) { return static_cast<std::int64_t>(std::floor(x / size)); };
    return {along(point.x()), along(point.y()), along(point.z())};
  }
  /// 21 bits an axis: a million cells either way. Two cells of one key would only be searched together.
  static std::uint64_t key(const Cell& cell) {
    const auto bits = [](std::int64_t x) { return static_cast<std::uint64_t>(x + (1 << 20)) & 0x1fffff; };
    return bits(cell.x) << 42 | bits(cell.y) << 21 | bits(cell.z);
  }

  std::span<const Sphere> spheres_;
  std::map<int, Level> levels_;
};

}  // namespace suffuse::analysis
