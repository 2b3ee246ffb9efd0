#include "suffuse/micromechanics/random_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "suffuse/common/error.h"

namespace suffuse::micromechanics {
namespace {

constexpr std::size_t kMostTries = 2000000;

/// Grains of similar size in cells at least as wide as the largest of them, so that a grain reaches its
/// neighbours in the next cells at most.
class SizeGrid {
 public:
  SizeGrid(const Vec3& sides, double largest) : sides_(sides), largest_(largest) {
    std::size_t all = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells_[axis] = std::max(1, static_cast<int>(std::min(sides[static_cast<int>(axis)] / largest, 200.0)));
      all *= static_cast<std::size_t>(cells_[axis]);
    }
    members_.resize(all);
  }

  double largest() const { return largest_; }
  void add(const PlacedGrain& grain) { members_[index(cell(grain.centre))].push_back(grain); }

  /// Whether a grain, no larger than those here, touches one of them.
  bool touches(const PlacedGrain& grain) const {
    const std::array<int, 3> at = cell(grain.centre);
    std::array<int, 3> from{}, to{};
    for (std::size_t axis = 0; axis < 3; ++axis) {  // of fewer than three cells all are looked at, each once
      from[axis] = cells_[axis] < 3 ? -at[axis] : -1;
      to[axis] = cells_[axis] < 3 ? cells_[axis] - 1 - at[axis] : 1;
    }
    for (int i = from[0]; i <= to[0]; ++i)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int k = from[2]; k <= to[2]; ++k)
          for (const PlacedGrain& other : members_[index(wrapped({at[0] + i, at[1] + j, at[2] + k}))])
            if (overlap(grain, other)) return true;
    return false;
  }

 private:
  std::array<int, 3> cell(const Vec3& centre) const {
    std::array<int, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      at[axis] = std::min(cells_[axis] - 1, static_cast<int>(centre[a] / sides_[a] * cells_[axis]));
    }
    return at;
  }
  std::array<int, 3> wrapped(std::array<int, 3> at) const {
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = (at[axis] + cells_[axis]) % cells_[axis];
    return at;
  }
  std::size_t index(const std::array<int, 3>& at) const {
    return static_cast<std::size_t>((at[0] * cells_[1] + at[1]) * cells_[2] + at[2]);
  }
  bool overlap(const PlacedGrain& one, const PlacedGrain& other) const {
    Vec3 apart = one.centre - other.centre;
    for (int axis = 0; axis < 3; ++axis) apart[axis] -= sides_[axis] * std::round(apart[axis] / sides_[axis]);
    const double reach = 0.5 * (one.diameter + other.diameter);
    return apart.squaredNorm() <= reach * reach;
  }

  Vec3 sides_;
  double largest_;
  std::array<int, 3> cells_{};
  std::vector<std::vector<PlacedGrain>> members_;
};

/// The same on every machine, other than the library's distributions.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

std::vector<PlacedGrain> place_at_random(std::span<const double> diameters, const Vec3& sides,
                                         std::uint64_t seed) {
  const double narrowest = sides.minCoeff();
  std::vector<double> sizes(diameters.begin(), diameters.end());
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  if (!sizes.empty() && !(sizes.front() < narrowest))
    throw_user_error({"sample", "largest grain", fmt::format("{:g} m", sizes.front()),
                      fmt::format("be smaller than the box, {:g} m", narrowest), "take more grains"});
  Uniform uniform(seed);
  std::vector<SizeGrid> grids;  // each down to half of its largest grain
  std::vector<PlacedGrain> placed;
  placed.reserve(sizes.size());
  for (const double size : sizes) {
    if (grids.empty() || size < grids.back().largest() / 2) grids.emplace_back(sides, size);
    PlacedGrain grain{Vec3::Zero(), size};
    std::size_t tries = 0;
    do {
      if (++tries > kMostTries)
        throw_user_error({"sample", "grain", fmt::format("{} of {}", placed.size() + 1, sizes.size()),
                          "find a place in the box", "lower --solid-fraction, or take another --seed"});
      grain.centre = Vec3(sides[0] * uniform(), sides[1] * uniform(), sides[2] * uniform());
    } while (
        std::any_of(grids.begin(), grids.end(), [&](const SizeGrid& grid) { return grid.touches(grain); }));
    grids.back().add(grain);
    placed.push_back(grain);
  }
  return placed;
}

}  // namespace suffuse::micromechanics
