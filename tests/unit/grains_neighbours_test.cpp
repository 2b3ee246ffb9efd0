// Pairs by size class against all pairs tried one by one.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "grains/size_class_pairs.h"

using suffuse::grains::SizeClassPairs;

namespace {

using Pairs = std::vector<std::pair<int, int>>;

struct Cloud {
  std::vector<double> positions, radii;
  int owned = 0;

  /// Radii spread evenly in their logarithm between 1 and `ratio` times 1e-4 m; a fifth of the spheres are
  /// copies, some of them outside the box of the others.
  Cloud(int count, double ratio, double box, unsigned seed) : owned(count - count / 5) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < count; ++i) {
      for (int d = 0; d < 3; ++d)
        positions.push_back(i < owned ? box * unit(random) : box * (1.4 * unit(random) - 0.2));
      radii.push_back(1e-4 * std::pow(ratio, unit(random)));
    }
  }
  suffuse::grains::Spheres spheres() const {
    return {positions.data(), radii.data(), owned, static_cast<int>(radii.size())};
  }
};

Pairs tried_one_by_one(const Cloud& cloud, double factor, double skin) {
  Pairs pairs;
  for (int i = 0; i < cloud.owned; ++i)
    for (int j = i + 1; j < static_cast<int>(cloud.radii.size()); ++j) {
      double square = 0;
      for (int d = 0; d < 3; ++d) {
        const double part = cloud.positions[static_cast<std::size_t>(3 * i + d)] -
                            cloud.positions[static_cast<std::size_t>(3 * j + d)];
        square += part * part;
      }
      const double cut =
          (cloud.radii[static_cast<std::size_t>(i)] + cloud.radii[static_cast<std::size_t>(j)]) * factor +
          skin;
      if (square <= cut * cut) pairs.emplace_back(i, j);
    }
  return pairs;
}

Pairs found(SizeClassPairs& search, const Cloud& cloud, double factor, double skin) {
  search.find(cloud.spheres(), factor, skin);
  Pairs pairs;
  for (int i = 0; i < cloud.owned; ++i)
    for (int k = 0; k < search.count(i); ++k) pairs.emplace_back(i, search.partners(i)[k]);
  return pairs;
}

}  // namespace

TEST_CASE(
    "size classes find the pairs that trying all finds, each once and in order, from 1:1 to 1:30 at any "
    "skin") {
  const double ratio = GENERATE(1., 2., 5.5, 30., 300.);
  const double skin = GENERATE(0., 1e-6, 1e-4, 2e-3);
  const double factor = GENERATE(1., 1.3);
  const double box = GENERATE(2e-3, 2e-2);
  SizeClassPairs search;  // one object for all, as between lists
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const Cloud cloud(400, ratio, box, seed);
    const Pairs expected = tried_one_by_one(cloud, factor, skin);
    CHECK(found(search, cloud, factor, skin) == expected);
  }
}

TEST_CASE("no spheres, one sphere, equal places and a flat layer are found like others") {
  SizeClassPairs search;
  CHECK(found(search, Cloud(0, 1, 1e-3, 1), 1, 0).empty());
  CHECK(found(search, Cloud(1, 1, 1e-3, 1), 1, 0).empty());
  Cloud same(10, 30, 1e-3, 3);
  std::fill(same.positions.begin(), same.positions.end(), 2e-3);
  CHECK(found(search, same, 1, 0).size() == 8 * 7 / 2 + 8 * 2);
  Cloud flat(300, 10, 5e-3, 4);
  for (std::size_t k = 2; k < flat.positions.size(); k += 3) flat.positions[k] = 1e-3;
  CHECK(found(search, flat, 1, 1e-4) == tried_one_by_one(flat, 1, 1e-4));
}
