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
  SizeGrid(double edge, double largest)
      : edge_(edge),
        largest_(largest),
        cells_(std::max(1, static_cast<int>(std::min(edge / largest, 200.0)))),
        members_(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_) *
                 static_cast<std::size_t>(cells_)) {}

  double largest() const { return largest_; }
  void add(const PlacedGrain& grain) { members_[index(cell(grain.centre))].push_back(grain); }

  /// Whether a grain, no larger than those here, touches one of them.
  bool touches(const PlacedGrain& grain) const {
    const std::array<int, 3> at = cell(grain.centre);
    const int reach = cells_ < 3 ? 0 : 1;  // with so few cells all are looked at, each once
    const int from = cells_ < 3 ? 0 : -reach, to = cells_ < 3 ? cells_ - 1 : reach;
    for (int i = from; i <= to; ++i)
      for (int j = from; j <= to; ++j)
        for (int k = from; k <= to; ++k)
          for (const PlacedGrain& other : members_[index(wrapped({at[0] + i, at[1] + j, at[2] + k}))])
            if (overlap(grain, other)) return true;
    return false;
  }

 private:
  std::array<int, 3> cell(const Vec3& centre) const {
    std::array<int, 3> at{};
    for (int axis = 0; axis < 3; ++axis)
      at[static_cast<std::size_t>(axis)] =
          std::min(cells_ - 1, static_cast<int>(centre[axis] / edge_ * cells_));
    return at;
  }
  std::array<int, 3> wrapped(std::array<int, 3> at) const {
    for (int& one : at) one = (one + cells_) % cells_;
    return at;
  }
  std::size_t index(const std::array<int, 3>& at) const {
    return static_cast<std::size_t>((at[0] * cells_ + at[1]) * cells_ + at[2]);
  }
  bool overlap(const PlacedGrain& one, const PlacedGrain& other) const {
    Vec3 apart = one.centre - other.centre;
    for (int axis = 0; axis < 3; ++axis) apart[axis] -= edge_ * std::round(apart[axis] / edge_);
    const double reach = 0.5 * (one.diameter + other.diameter);
    return apart.squaredNorm() <= reach * reach;
  }

  double edge_, largest_;
  int cells_;
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

std::vector<PlacedGrain> place_at_random(std::span<const double> diameters, double edge, std::uint64_t seed) {
  std::vector<double> sizes(diameters.begin(), diameters.end());
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  if (!sizes.empty() && !(sizes.front() < edge))
    throw_user_error({"sample", "largest grain", fmt::format("{:g} m", sizes.front()),
                      fmt::format("be smaller than the box, {:g} m", edge), "take more grains"});
  Uniform uniform(seed);
  std::vector<SizeGrid> grids;  // each down to half of its largest grain
  std::vector<PlacedGrain> placed;
  placed.reserve(sizes.size());
  for (const double size : sizes) {
    if (grids.empty() || size < grids.back().largest() / 2) grids.emplace_back(edge, size);
    PlacedGrain grain{Vec3::Zero(), size};
    std::size_t tries = 0;
    do {
      if (++tries > kMostTries)
        throw_user_error({"sample", "grain", fmt::format("{} of {}", placed.size() + 1, sizes.size()),
                          "find a place in the box", "lower --solid-fraction, or take another --seed"});
      grain.centre = Vec3(edge * uniform(), edge * uniform(), edge * uniform());
    } while (
        std::any_of(grids.begin(), grids.end(), [&](const SizeGrid& grid) { return grid.touches(grain); }));
    grids.back().add(grain);
    placed.push_back(grain);
  }
  return placed;
}

}  // namespace suffuse::micromechanics
