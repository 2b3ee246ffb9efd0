// How much of each cell a sphere covers: every method against an independent quadrature, and as a function of
// the position.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "coupled_scene.h"

using namespace suffuse;
using namespace suffuse::coupling;
using namespace suffuse::coupling::test;

namespace {

constexpr int kCells = 16;

/// Volume of a sphere about the origin in the unit cube about `centre`: exact along x, midpoint rule with 100
/// by 100 lines across. Against 400 by 400 lines it changes by less than 2e-4.
double covered_volume(const Vec3& centre, double radius) {
  constexpr int lines = 100;
  double sum = 0;
  for (int j = 0; j < lines; ++j)
    for (int k = 0; k < lines; ++k) {
      const double y = centre[1] - 0.5 + (j + 0.5) / lines, z = centre[2] - 0.5 + (k + 0.5) / lines;
      const double square = radius * radius - y * y - z * z;
      if (square <= 0) continue;
      const double half = std::sqrt(square);
      sum += std::max(0., std::min(centre[0] + 0.5, half) - std::max(centre[0] - 0.5, -half));
    }
  return sum / (lines * lines);
}

SolidSettings with(FractionMethod method) {
  SolidSettings solids = fixed_solids(5);
  solids.fraction = method;
  solids.remap_distance = 0;
  return solids;
}

/// Fractions that one sphere gives to the cells of a small box.
class Covered {
 public:
  explicit Covered(FractionMethod method)
      : scene_(lattice_settings(0.8, with(method)), {kCells, kCells, kCells}, {sphere_at(Vec3(8, 8, 8), 1)}) {
  }

  void place(const Vec3& position, double radius) {
    scene_.grains.list[0].position = position;
    scene_.grains.list[0].radius = radius;
    scene_.simulation->map();
  }
  double at(int x, int y, int z) const { return scene_.simulation->fluid().solid_fraction({x, y, z}); }
  double volume() const {
    double sum = 0;
    lbm::for_each_cell(scene_.simulation->fluid().decomposition().local_box(),
                       [&](int x, int y, int z) { sum += at(x, y, z); });
    return sum;
  }

 private:
  Scene scene_;
};

struct FractionErrors {
  double mean = 0, largest = 0;  ///< of cells that the surface cuts
  double volume = 0;             ///< largest relative error of a sphere's volume
};

FractionErrors errors_of(FractionMethod method, double radius) {
  Covered covered(method);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  FractionErrors errors;
  int cut = 0;
  for (int n = 0; n < 8; ++n) {
    const Vec3 position = Vec3(8, 8, 8) + Vec3(unit(random), unit(random), unit(random));
    covered.place(position, radius);
    for (int x = 0; x < kCells; ++x)
      for (int y = 0; y < kCells; ++y)
        for (int z = 0; z < kCells; ++z) {
          const Vec3 centre = Vec3(x + 0.5, y + 0.5, z + 0.5) - position;
          const double gap = std::abs(centre.norm() - radius);
          if (gap > 0.87 && covered.at(x, y, z) == (centre.norm() < radius ? 1. : 0.)) continue;
          const double error = std::abs(covered.at(x, y, z) - covered_volume(centre, radius));
          errors.largest = std::max(errors.largest, error);
          errors.mean += error;
          ++cut;
        }
    const double exact = sphere_volume(radius);
    errors.volume = std::max(errors.volume, std::abs(covered.volume() / exact - 1));
  }
  errors.mean /= cut;
  return errors;
}

struct Bounds {
  FractionMethod method;
  double radius, mean, largest, volume;
};

}  // namespace

TEST_CASE("fractions agree with a quadrature of sphere and cube") {
  // Half as much again as random positions showed. `exact` takes what lies between the surface within a cell
  // and a plane from the plane's section, so that its error falls with the radius (and cuts cells up below a
  // radius of one and a half); `linear` ignores the orientation of the surface: as good at any radius;
  // sub-cells miss a layer of half a sub-cell at random.
  const Bounds bounds = GENERATE(Bounds{FractionMethod::exact, 0.3, 0.0001, 0.0007, 0.006},
                                 Bounds{FractionMethod::exact, 0.7, 0.0003, 0.0013, 0.0043},
                                 Bounds{FractionMethod::exact, 1.3, 0.0006, 0.0023, 0.0028},
                                 Bounds{FractionMethod::exact, 1.6, 0.0030, 0.016, 0.005},
                                 Bounds{FractionMethod::exact, 2.5, 0.0016, 0.006, 0.0026},
                                 Bounds{FractionMethod::exact, 5., 0.0008, 0.0043, 0.0007},
                                 Bounds{FractionMethod::linear, 2.5, 0.03, 0.10, 0.02},
                                 Bounds{FractionMethod::linear, 5., 0.03, 0.10, 0.003},
                                 Bounds{FractionMethod::subcells, 2.5, 0.014, 0.15, 0.012},
                                 Bounds{FractionMethod::subcells, 5., 0.012, 0.15, 0.003});
  const FractionErrors errors = errors_of(bounds.method, bounds.radius);
  INFO("method " << static_cast<int>(bounds.method) << " radius " << bounds.radius << ": mean " << errors.mean
                 << " largest " << errors.largest << " volume " << errors.volume);
  CHECK(errors.mean < bounds.mean);
  CHECK(errors.largest < bounds.largest);
  CHECK(errors.volume < bounds.volume);
}

TEST_CASE("smooth fractions change in proportion to a small motion, those of sub-cells jump") {
  // The steepest change of a fraction is that of a cell crossed by the surface face on: one per cell of way.
  const auto largest_change = [](FractionMethod method, double way) {
    Covered covered(method);
    double largest = 0;
    const Vec3 direction = Vec3(0.6, 0.64, 0.48);
    std::vector<double> before;
    for (int n = 0; n < 60; ++n) {
      covered.place(Vec3(7.9, 8.1, 8.2) + n * way * direction, 2.6);
      std::vector<double> now;
      lbm::for_each_cell(lbm::CellBox{{0, 0, 0}, {kCells, kCells, kCells}},
                         [&](int x, int y, int z) { now.push_back(covered.at(x, y, z)); });
      for (std::size_t i = 0; i < before.size(); ++i)
        largest = std::max(largest, std::abs(now[i] - before[i]));
      before = now;
    }
    return largest;
  };
  // 1.4: a plane that enters by a corner covers no faster than the cell's diagonal section allows.
  CHECK(largest_change(FractionMethod::exact, 0.002) < 1.4 * 0.002);
  CHECK(largest_change(FractionMethod::linear, 0.002) < 1.1 * 0.002);
  CHECK(largest_change(FractionMethod::subcells, 0.002) > 0.99 / 125);
}
