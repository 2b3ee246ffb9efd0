#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "grading/packing_constrictions.h"
#include "suffuse/common/error.h"

using namespace suffuse;
using namespace suffuse::analysis;

namespace {

/// `cells`³ unit cells of edge `edge`, a grain of diameter 1 at each of `places` (in edges).
std::pair<std::vector<Sphere>, SphereBox> array_of(const std::vector<Vec3>& places, double edge, int cells) {
  std::vector<Sphere> grains;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k)
        for (const Vec3& place : places) grains.push_back({(Vec3(i, j, k) + place) * edge, 0.5});
  SphereBox box;
  box.high = Vec3::Constant(cells * edge);
  return {grains, box};
}

std::pair<std::vector<Sphere>, SphereBox> simple_cubic(int cells) {
  return array_of({Vec3(0, 0, 0)}, 1, cells);
}

std::pair<std::vector<Sphere>, SphereBox> face_centred(int cells) {
  return array_of({Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)}, std::sqrt(2.0),
                  cells);
}

}  // namespace

TEST_CASE("simple cubic: one pore a grain, three constrictions of (sqrt 2 - 1) D") {
  const auto [grains, box] = simple_cubic(4);
  const PackingConstrictions found = packing_constrictions(grains, box);
  CHECK(found.pore_diameters.size() == 64);
  CHECK(found.constrictions.size() == 192);
  CHECK(found.closed == 0);
  for (const Constriction& one : found.constrictions) CHECK(one.diameter == Approx(std::sqrt(2.0) - 1));
  for (const double pore : found.pore_diameters) CHECK(pore == Approx(std::sqrt(3.0) - 1));
}

TEST_CASE("face-centred cubic: three-grain constrictions of 0.1547 D between two kinds of pores") {
  const auto [grains, box] = face_centred(3);  // 27 cells of 4 grains, 8 tetrahedra and 4 octahedra
  const PackingConstrictions found = packing_constrictions(grains, box);
  CHECK(found.pore_diameters.size() == 27 * 12);
  CHECK(found.constrictions.size() ==
        27 * 32);  // each tetrahedron has four faces, every one to an octahedron
  for (const Constriction& one : found.constrictions) CHECK(one.diameter == Approx(2 / std::sqrt(3.0) - 1));
  int octahedral = 0;
  for (const double pore : found.pore_diameters) {
    const bool is_octahedral = pore > 0.3;
    octahedral += is_octahedral;
    CHECK(pore == Approx(is_octahedral ? std::sqrt(2.0) - 1 : std::sqrt(1.5) - 1));
  }
  CHECK(octahedral == 27 * 4);
}

TEST_CASE("face-centred cubic stays itself where rounding has moved the grains") {
  // Octahedra are cut into four tetrahedra or, with moved grains, in other ways with flat pieces; the merging
  // must undo all of them.
  auto [grains, box] = face_centred(3);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> move(-1e-7, 1e-7);
  for (Sphere& grain : grains)
    for (int axis = 0; axis < 3; ++axis) grain.centre[axis] += move(random);
  const PackingConstrictions found = packing_constrictions(grains, box);
  CHECK(found.pore_diameters.size() == 27 * 12);
  CHECK(found.constrictions.size() == 27 * 32);
  for (const Constriction& one : found.constrictions)
    CHECK(one.diameter == Approx(2 / std::sqrt(3.0) - 1).epsilon(1e-5));
}

TEST_CASE("body-centred cubic: three-grain constrictions of its own triangle") {
  // Edge 2/√3 D; faces are isosceles triangles 1, 1, 2/√3 (in D). Disc on their axis at y from the base's
  // middle: √(1/3 + y²) = h − y with h = √(2/3): y = (h² − 1/3)/(2h), diameter 2(h − y) − 1.
  const auto [grains, box] = array_of({Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5)}, 2 / std::sqrt(3.0), 3);
  const double h = std::sqrt(2.0 / 3), y = (h * h - 1.0 / 3) / (2 * h);
  const PackingConstrictions found = packing_constrictions(grains, box);
  REQUIRE_FALSE(found.constrictions.empty());
  for (const Constriction& one : found.constrictions) CHECK(one.diameter == Approx(2 * (h - y) - 1));
}

TEST_CASE("the origin of the box and where grains were wrapped do not matter") {
  const auto [grains, box] = face_centred(3);
  std::vector<Sphere> moved = grains;
  const double edge = box.high.x() - box.low.x();
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i].centre += Vec3(0.31, 0.17, 0.053) * edge;
    if (i % 3 == 0) moved[i].centre.x() += edge;  // outside of the box along a periodic direction
  }
  CHECK(packing_constrictions(moved, box).constrictions.size() ==
        packing_constrictions(grains, box).constrictions.size());
}

TEST_CASE("a fine grain in the way narrows the constriction") {
  // A grain of 0.2 in the middle of each square of the simple cubic array: what is left of a square of side 1
  // around it is the disc that touches it and two neighbours on a side.
  const auto [coarse, box] = simple_cubic(3);
  std::vector<Sphere> grains = coarse;
  for (const Sphere& grain : coarse) grains.push_back({grain.centre + Vec3(0.5, 0.5, 0), 0.1});
  const PackingConstrictions found = packing_constrictions(grains, box);
  // On the axis of one side, at x from the side's middle: √(0.25 + x²) − 0.5 = 0.5 − x − 0.1 ⇒ x = (0.9² −
  // 0.25)/1.8.
  const double x = (0.81 - 0.25) / 1.8, diameter = 2 * (0.9 - x - 0.5);
  int narrowed = 0, open = 0;
  for (const Constriction& one : found.constrictions) {
    if (std::abs(one.normal.z()) < 0.99) {
      open += std::abs(one.diameter - (std::sqrt(2.0) - 1)) < 1e-9;
      continue;
    }
    CHECK(one.diameter == Approx(diameter));
    ++narrowed;
  }
  CHECK(narrowed == 27 * 4);  // one on each side of the fine grain
  CHECK(open > 0);            // squares across x and y are as before
}

TEST_CASE("no disc of a random packing touches any grain, and every one is tangent to three") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  SphereBox box;
  box.high = Vec3::Constant(6);
  std::vector<Sphere> grains;
  for (int attempt = 0; attempt < 20000 && grains.size() < 350; ++attempt) {  // random sequential addition
    const Sphere next{Vec3(uniform(random), uniform(random), uniform(random)) * 6,
                      0.15 + 0.35 * uniform(random)};
    bool free = true;
    for (const Sphere& grain : grains) {
      Vec3 apart = grain.centre - next.centre;
      for (int axis = 0; axis < 3; ++axis) apart[axis] -= 6 * std::round(apart[axis] / 6);
      free = free && apart.norm() > grain.radius + next.radius;
    }
    if (free) grains.push_back(next);
  }
  const PackingConstrictions found = packing_constrictions(grains, box);
  REQUIRE(found.constrictions.size() > grains.size());
  for (const Constriction& one : found.constrictions) {
    int touching = 0;
    double overlap = 0;
    for (const Sphere& grain : grains) {
      Vec3 apart = grain.centre - one.centre;
      for (int axis = 0; axis < 3; ++axis) apart[axis] -= 6 * std::round(apart[axis] / 6);
      const double height = apart.dot(one.normal);
      if (std::abs(height) >= grain.radius) continue;
      const double cut = std::sqrt(grain.radius * grain.radius - height * height);
      const double between =
          std::sqrt(std::max(0.0, apart.squaredNorm() - height * height)) - cut - one.diameter / 2;
      touching += std::abs(between) < 1e-6;
      overlap = std::max(overlap, -between);
    }
    CHECK(touching >= 3);
    CHECK(overlap < 1e-6);
  }
}

TEST_CASE("merging: any overlap joins more than half an overlap, which joins more than none") {
  std::mt19937 random(29);
  std::uniform_real_distribution<double> uniform(0, 1);
  auto [grains, box] = simple_cubic(4);
  for (Sphere& grain : grains)
    for (int axis = 0; axis < 3; ++axis) grain.centre[axis] += 0.1 * uniform(random);
  for (Sphere& grain : grains) grain.radius = 0.4;
  const std::size_t most = packing_constrictions(grains, box, 1).pore_diameters.size();
  const std::size_t some = packing_constrictions(grains, box, 0.5).pore_diameters.size();
  const std::size_t least = packing_constrictions(grains, box, 0).pore_diameters.size();
  CHECK(least < some);
  CHECK(some < most);
}

TEST_CASE("between walls the hull is left out") {
  auto [grains, box] = simple_cubic(4);
  box.periodic = {false, false, false};
  const PackingConstrictions found = packing_constrictions(grains, box);
  CHECK(found.pore_diameters.size() == 27);        // cubes of eight grains
  CHECK(found.constrictions.size() == 3 * 2 * 9);  // squares between two cubes
}

TEST_CASE("packings that cannot be analysed are refused") {
  auto [grains, box] = simple_cubic(2);
  CHECK_THROWS_AS(packing_constrictions(std::vector<Sphere>(grains.begin(), grains.begin() + 3), box),
                  UserError);
  CHECK_THROWS_AS(packing_constrictions(grains, box, 1.5), UserError);
  grains[0].radius = -1;
  CHECK_THROWS_AS(packing_constrictions(grains, box), UserError);
  grains[0].radius = 0.5;
  box.high.x() = box.low.x();
  CHECK_THROWS_AS(packing_constrictions(grains, box), UserError);
}
