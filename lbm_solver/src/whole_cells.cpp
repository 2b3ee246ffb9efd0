#include "suffuse/lbm/whole_cells.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "suffuse/common/error.h"

namespace suffuse::lbm {

namespace {

// A thousandth of a cell over the whole box is how a person rounds, not another geometry.
constexpr double kRounding = 1e-3;

double distance_from_whole(double length, double spacing) {
  const double exact = length / spacing;
  return std::abs(exact - std::max(1., std::round(exact)));
}

bool fits(const Vec3& size, double spacing) {
  for (int a = 0; a < 3; ++a)
    if (distance_from_whole(size[a], spacing) > kRounding) return false;
  return true;
}

/// Among the spacings that divide the first axis and are within a third of the one that was asked for.
std::optional<double> nearest_fitting_spacing(const Vec3& size, double spacing) {
  std::optional<double> best;
  const long least = std::lround(size[0] / spacing / 1.33), most = std::lround(size[0] / spacing * 1.33) + 1;
  for (long n = std::max(1L, least); n <= most; ++n) {
    const double candidate = size[0] / static_cast<double>(n);
    if (fits(size, candidate) && (!best || std::abs(candidate - spacing) < std::abs(*best - spacing)))
      best = candidate;
  }
  return best;
}

}  // namespace

Index3 whole_cells(const Vec3& size, double spacing, const std::string& who) {
  Index3 cells{};
  for (int a = 0; a < 3; ++a) {
    const double whole = std::max(1., std::round(size[a] / spacing));
    if (!(size[a] > 0))
      throw_user_error({who, fmt::format("size along {}", "xyz"[a]), fmt::format("{:g} m", size[a]), "be > 0",
                        "the region must lie in the box"});
    constexpr double most = 1e6;
    if (whole > most)
      throw_user_error({who, "spacing", fmt::format("{:g} m", spacing),
                        fmt::format("give at most {:g} cells along an axis, not {:g}", most, whole),
                        "SI units"});
    if (distance_from_whole(size[a], spacing) > kRounding) {
      const auto other = nearest_fitting_spacing(size, spacing);
      throw_user_error({who, fmt::format("size along {}", "xyz"[a]), fmt::format("{:g} m", size[a]),
                        fmt::format("be a whole number of cells of {:g} m", spacing),
                        other ? fmt::format("spacing {:.9g} fits all three axes", *other)
                              : fmt::format("a size of {:.9g} m fits", whole * spacing)});
    }
    cells[static_cast<std::size_t>(a)] = static_cast<int>(whole);
  }
  return cells;
}

}  // namespace suffuse::lbm
