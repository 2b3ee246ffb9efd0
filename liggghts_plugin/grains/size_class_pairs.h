#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace suffuse::grains {

/// Positions (m, three a sphere) and radii (m, > 0) of spheres: `owned` ones first, then copies of others.
struct Spheres {
  const double* positions;
  const double* radii;
  int owned;
  int all;
};

/// All pairs of spheres that are near each other, found with one grid of cells for each class of sizes.
///
/// A class spans a factor of two in radius, and its cells fit its own largest spheres: small spheres are not
/// looked for in cells as wide as the largest sphere, which is what makes lists of graded soils slow
/// (`ogarko2012`). Pairs within a class are found by looking ahead in the order of cells; a sphere of a
/// larger class asks the grids of all smaller ones; copies ask all classes.
class SizeClassPairs {
 public:
  /// Finds each pair with distance <= distance_factor * (r_i + r_j) + skin of which at least one is owned,
  /// once. Positions must be finite.
  void find(const Spheres& spheres, double distance_factor, double skin);

  /// Partners of an owned sphere: those with a higher index, in ascending order.
  const int* partners(int sphere) const {
    return partners_.data() + first_[static_cast<std::size_t>(sphere)];
  }
  int count(int sphere) const {
    const auto i = static_cast<std::size_t>(sphere);
    return static_cast<int>(first_[i + 1] - first_[i]);
  }
  std::size_t total() const { return partners_.size(); }

 private:
  static constexpr int kClasses = 16;  // 1 to 65,536 in radius; the last one takes what is larger

  /// A sphere in the order of cells.
  struct Spot {
    double x, y, z, radius;
    int sphere, cell;
  };
  /// The grid of one class.
  struct Class {
    double largest = 0, width = 0, inverse_width = 0;
    std::array<double, 3> low{};
    std::array<int, 3> cells{};
    std::vector<int> start;  // of each cell in spots, and the end
    std::vector<Spot> spots;

    int cell_of(double position, std::size_t axis) const;
  };

  void sort_into_classes(const Spheres& spheres, double distance_factor, double skin);
  void pairs_within(const Class& of, double distance_factor, double skin);
  void partners_in(const Class& of, const Spot& asking, bool asking_is_owned, double distance_factor,
                   double skin);
  void gather_by_owner(int owned);
  void add(int a, int b);

  std::array<Class, kClasses> classes_;
  std::vector<signed char> class_of_;
  std::vector<int> cell_of_;
  std::vector<int> pair_first_, pair_second_;
  std::size_t pairs_ = 0;
  std::vector<std::size_t> first_, next_;
  std::vector<int> partners_;
};

}  // namespace suffuse::grains
