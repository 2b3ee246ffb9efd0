// From gradings to grains, and the thesis's samples whose gradings were recovered.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "grading_samples.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/grain_sample.h"
#include "suffuse/micromechanics/internal_stability.h"
#include "suffuse/micromechanics/random_placement.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

using Points = std::vector<GradingPoint>;

double split_of(const Grading& grading) {
  return std::sqrt(grading.gap()->finer_diameter * grading.gap()->coarser_diameter);
}

/// Of the masses of so many spheres of each size.
double mass_of(const SampleClass& one) {
  return one.grains * std::pow(one.diameter, 3);
}

}  // namespace

TEST_CASE("numbers of grains have the mass fractions of their grading") {
  for (const Grading& grading :
       {appendix("A"), power_law(1e-4, 2e-3, 0.5),
        Grading::from_curve(Points{{1e-4, 0}, {2e-4, 0.27}, {6e-4, 0.27}, {1e-3, 1}})}) {
    const auto classes = sample_classes(
        grading.unknown_below() > 0 ? cut_below(grading, grading.smallest()).grading : grading);
    const GrainSample sample = grain_sample(classes, 5000, 5e-4);
    double all = 0, grains = 0;
    for (const SampleClass& one : sample.classes) {
      all += mass_of(one);
      grains += one.grains;
    }
    CHECK(grains == Approx(5000));
    for (std::size_t k = 0; k < classes.size(); ++k)
      CHECK(mass_of(sample.classes[k]) / all == Approx(classes[k].mass));
  }
}

TEST_CASE("the classes of a curve keep its mass between their ends, and its fines content at a gap") {
  const Grading straight = Grading::from_curve(Points{{1e-4, 0}, {1e-2, 1}});
  const auto twenty = sample_classes(straight, 20);
  REQUIRE(twenty.size() == 20);
  for (std::size_t k = 0; k < 20; ++k) {
    CHECK(twenty[k].mass == Approx(0.05));
    CHECK(twenty[k].diameter == Approx(1e-4 * std::pow(100, (static_cast<double>(k) + 0.5) / 20)));
  }
  const Grading gapped = Grading::from_curve(Points{{1e-4, 0}, {2e-4, 0.27}, {6e-4, 0.27}, {1e-3, 1}});
  const auto classes = sample_classes(gapped, 20);
  CHECK(classes.size() == 20);
  const double fines = std::accumulate(
      classes.begin(), classes.end(), 0.0,
      [](double sum, const GradingClass& one) { return sum + (one.diameter < 4e-4 ? one.mass : 0); });
  CHECK(fines == Approx(0.27));  // five classes of 5.4 %; twenty equal ones would make it 25 or 30 %
}

TEST_CASE("20,000 grains of Appendix A stand in its box of 5.8 mm, a smaller sample in a wider one") {
  const Grading grading = appendix("A");
  const auto classes = sample_classes(grading);
  CHECK(classes == grading.own_classes());
  const double solid = placing_solid_fraction(classes);
  CHECK(placing_box_edge(grain_sample(classes, 20000, 3e-4), solid) == Approx(5.8e-3).epsilon(1e-5));
  CHECK(placing_box_edge(grain_sample(classes, 1500, 3e-4), solid) ==
        Approx(1.1 * 5.8e-3 * std::cbrt(0.075)).epsilon(1e-5));
  // 80 % of Appendix B are within 1.4:1; Appendix B leaves more room still, 11.24 mm.
  const auto of_b = sample_classes(appendix("B"));
  CHECK(0.8 * placing_solid_fraction(of_b) == Approx(0.3534).epsilon(1e-4));
}

TEST_CASE("a grading without its finest grains") {
  const CutGrading curve = cut_below(Grading::from_curve(Points{{1e-4, 0.2}, {1e-3, 0.6}, {1e-2, 1}}), 1e-3);
  CHECK(curve.lost == Approx(0.6));
  CHECK(curve.grading.smallest() == 1e-3);
  CHECK(curve.grading.unknown_below() == 0);
  CHECK(curve.grading.finer_at(std::sqrt(1e-5)) == Approx(0.5));
  const CutGrading classes = cut_below(appendix("A"), 3e-4);
  CHECK(classes.lost == Approx(0.30));
  CHECK(classes.grading.own_classes().size() == 14);
  CHECK_THROWS_AS(cut_below(appendix("A"), 1.14e-3), UserError);
  CHECK_THROWS_AS(cut_below(Grading::from_curve(Points{{1e-4, 0.2}, {1e-2, 1}}), 0.9e-4), UserError);
  CHECK_THROWS_AS(sample_classes(Grading::from_curve(Points{{1e-4, 0.2}, {1e-2, 1}})), UserError);
}

TEST_CASE("recovered gradings have the numbers of grains that the thesis prints") {
  // For 500 coarse ones (section 4.3), against N_p of Tables 4.1 and 5.1, printed to a thousand or five. 15 %
  // of fines is the odd one: 8,149 and 22,867 against "10,000" and "25,000".
  const std::map<std::string, std::pair<double, double>> printed{
      {"A10", {5000, 0.07}},         {"A15", {10000, 0.19}},       {"A20", {12000, 0.06}},
      {"A40", {30000, 0.03}},        {"B10", {15000, 0.03}},       {"B15", {25000, 0.09}},
      {"B20", {35000, 0.09}},        {"B30", {55000, 0.01}},       {"B40", {85000, 0.001}},
      {"11b", {69000, 0.02}},        {"11c", {90000, 0.001}},      {"11d", {116000, 0.03}},
      {"appendix_A", {20000, 0.05}}, {"appendix_B", {53000, 0.01}}};
  for (const auto& [name, expected] : printed) {
    INFO(name);
    const Grading grading = grading_file(name);
    CHECK(grains_with_coarse(grading.own_classes(), 500, split_of(grading)) ==
          Approx(expected.first).epsilon(expected.second));
  }
}

TEST_CASE("grains with every size: one of the rarest, the others by their mass over the cube of the size") {
  // Equal masses of 1, 2 and 4 mm: 64, 8 and 1 grain.
  const std::vector<GradingClass> classes{{1e-3, 0.2}, {2e-3, 0.2}, {4e-3, 0.2}};
  CHECK(grains_with_every_size(classes) == Approx(73));
  // With a hundredth of the mass the finest is the rarest: 0.64, 8 and 1.
  CHECK(grains_with_every_size(std::vector<GradingClass>{{1e-3, 0.002}, {2e-3, 0.2}, {4e-3, 0.2}}) ==
        Approx(9.64 / 0.64));
}

TEST_CASE("recovered gradings have the ratios of Kezdi, and of Kenney and Lau, that Table 4.1 prints") {
  struct Row {
    const char* name;
    double kezdi, kezdi_tolerance, kenney_lau, kenney_lau_tolerance;
  };
  // Splits from F = 5 % on: 7a's 4.720 comes out so, and no other row changes. The classes of Appendix B are
  // 15 % apart at its finest, half of which is the resolution of an end. 8a's (H/F)min does not come
  // out: 2.33 for 2.70.
  const Row rows[] = {{"A20", 3.330, 0.01, 2.700, 0.14},   {"appendix_A", 2.810, 0.005, 1.590, 0.001},
                      {"B10", 4.720, 0.002, 0.970, 0.015}, {"B20", 4.760, 0.011, 0.980, 0.025},
                      {"B30", 3.990, 0.011, 0.790, 0.018}, {"appendix_B", 6.620, 0.05, 0, 0},
                      {"11b", 6.420, 0.005, 0, 0},         {"11c", 6.240, 0.016, 0, 0},
                      {"11d", 6.360, 0.05, 0.160, 0.05}};
  for (const Row& row : rows) {
    INFO(row.name);
    const Grading grading = grading_file(row.name);
    CHECK(maximum_split_ratio(grading, 0.05).ratio == Approx(row.kezdi).epsilon(row.kezdi_tolerance));
    CHECK(minimum_shape_ratio(grading).ratio ==
          Approx(row.kenney_lau).epsilon(row.kenney_lau_tolerance).margin(1e-12));
  }
  CHECK(maximum_split_ratio(grading_file("B10")).ratio == Approx(6.109).epsilon(1e-3));  // of all splits
}

TEST_CASE("whole numbers of grains add up, and no class is off by a grain") {
  const GrainSample sample = grain_sample(sample_classes(grading_file("B20")), 777, 2.5e-4);
  const std::vector<std::size_t> numbers = whole_numbers(sample);
  CHECK(std::accumulate(numbers.begin(), numbers.end(), std::size_t{0}) == 777);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    CHECK(std::abs(static_cast<double>(numbers[k]) - sample.classes[k].grains) < 1);
}

TEST_CASE(
    "grains placed at random touch none, through the sides either, and stand there again with the same "
    "seed") {
  // Three sizes 12:1, so that the grids of several levels are passed; half of the box is solid.
  std::vector<double> diameters(40, 1.2e-3);
  diameters.insert(diameters.end(), 300, 4e-4);
  diameters.insert(diameters.end(), 3000, 1e-4);
  double solids = 0;
  for (const double d : diameters) solids += 3.14159265358979 / 6 * d * d * d;
  const double edge = std::cbrt(solids / 0.4);
  const Vec3 sides = GENERATE(Vec3(1, 1, 1), Vec3(0.7, 0.8, 1 / 0.56)) * edge;  // a cube, and a column
  const auto grains = place_at_random(diameters, sides, 7);
  REQUIRE(grains.size() == diameters.size());
  double nearest = 1;
  for (std::size_t i = 0; i < grains.size(); ++i)
    for (std::size_t j = i + 1; j < grains.size(); ++j) {
      Vec3 apart = grains[i].centre - grains[j].centre;
      for (int axis = 0; axis < 3; ++axis) apart[axis] -= sides[axis] * std::round(apart[axis] / sides[axis]);
      nearest = std::min(nearest, apart.norm() - (grains[i].diameter + grains[j].diameter) / 2);
    }
  CHECK(nearest > 0);
  const auto again = place_at_random(diameters, sides, 7), other = place_at_random(diameters, sides, 8);
  CHECK(again.back().centre == grains.back().centre);
  CHECK(other.back().centre != grains.back().centre);
  // Uniform: the mean of so many centres is the middle, within four standard errors of side/sqrt(12 n).
  Vec3 mean = Vec3::Zero();
  for (const PlacedGrain& grain : grains) mean += grain.centre / static_cast<double>(grains.size());
  CHECK((mean.cwiseQuotient(sides) - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() <
        4 / std::sqrt(12.0 * static_cast<double>(grains.size())));
  CHECK_THROWS_AS(place_at_random(std::vector<double>{1e-3}, Vec3(1, 0.9e-3, 1), 1), UserError);
  // A grain as wide as a third of the box, in which no cell is left out.
  CHECK(place_at_random(std::vector<double>(8, 1e-3), Vec3::Constant(2.9e-3), 3).size() == 8);
}
