#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "grading_samples.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/grading.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

std::string refusal(const std::vector<GradingClass>& classes) {
  try {
    Grading::from_classes(classes);
  } catch (const UserError& problem) {
    return problem.what();
  }
  return "";
}

std::string curve_refusal(const std::vector<GradingPoint>& points) {
  try {
    Grading::from_curve(points);
  } catch (const UserError& problem) {
    return problem.what();
  }
  return "";
}

}  // namespace

TEST_CASE("sizes of a straight line over log d are where the line is") {
  // W from 0 at 0.1 mm to 1 at 10 mm: d_x = 0.1 mm × 100^x.
  const Grading line = Grading::from_curve(std::vector<GradingPoint>{{1e-4, 0}, {1e-2, 1}});
  const GradingIndices indices = grading_indices(line);
  CHECK(indices.d10 == Approx(1e-4 * std::pow(100, 0.1)));
  CHECK(indices.d50 == Approx(1e-3));
  CHECK(indices.uniformity == Approx(std::pow(100, 0.5)));             // 100^(0.6 − 0.1)
  CHECK(indices.curvature == Approx(std::pow(100, 0.6 - 0.1 - 0.6)));  // 100^(2×0.3 − 0.1 − 0.6)
  // Sauter's size: 1/∫ dW/d = ln 100/(1/1e-4 − 1/1e-2); 200 classes of equal mass, midpoint rule, h =
  // ln100/200
  CHECK(indices.sauter == Approx(std::log(100) / (1e4 - 1e2)).epsilon(1e-4));
  CHECK(line.finer_at(1e-3) == Approx(0.5));
  CHECK_FALSE(line.gap());
}

TEST_CASE("a gap in the curve is found with its ratio and its fines content") {
  const Grading gapped = Grading::from_curve(std::vector<GradingPoint>{
      {1e-4, 0}, {2e-4, 0.25}, {5e-4, 0.255}, {8e-4, 0.26}, {1e-3, 0.6}, {2e-3, 1}});
  REQUIRE(gapped.gap());
  CHECK(gapped.gap()->ratio() == Approx(4));
  CHECK(gapped.gap()->finer == Approx(0.25));
}

TEST_CASE("classes of a binary mixture stay single sizes") {
  const Grading binary = Grading::from_classes(std::vector<GradingClass>{{1e-3, 1}, {6e-3, 3}});
  CHECK(binary.diameter_at(0.2) == Approx(1e-3));
  CHECK(binary.diameter_at(0.3) == Approx(6e-3));
  CHECK(binary.finer_below(1e-3) == 0);
  CHECK(binary.finer_at(1e-3) == Approx(0.25));
  REQUIRE(binary.gap());
  CHECK(binary.gap()->ratio() == Approx(6));
  CHECK(effective_diameter(binary.classes()) == Approx(1 / (0.25 / 1e-3 + 0.75 / 6e-3)));
}

TEST_CASE("the bins of Appendix A give back the sieves that they stand for") {
  // 0.212 and 0.425 mm are sieves of the series that the sample was mixed from; the classes are 7.5 and 12 %
  // wide, so half a class is the most by which an end may be off.
  const Grading appendix_a = appendix("A");
  REQUIRE(appendix_a.gap());
  CHECK(appendix_a.gap()->finer_diameter == Approx(0.212e-3).epsilon(0.02));
  CHECK(appendix_a.gap()->coarser_diameter == Approx(0.425e-3).epsilon(0.02));
  CHECK(appendix_a.gap()->finer == Approx(0.30));
  CHECK(appendix_a.gap()->class_ratio == Approx(2.185).epsilon(1e-3));
}

TEST_CASE("grains and their classes give the same grading") {
  std::vector<double> grains;
  for (int i = 0; i < 640; ++i) grains.push_back(1e-3);
  for (int i = 0; i < 10; ++i) grains.push_back(4e-3);  // 10 × 64: as much mass
  const Grading from_grains = Grading::from_grains(grains);
  REQUIRE(from_grains.classes().size() == 2);
  CHECK(from_grains.classes()[0].mass == Approx(0.5));
}

TEST_CASE("random grains: the curve rises and ends at 1, its inverse is its inverse") {
  std::mt19937 random(5);
  std::lognormal_distribution<double> sizes(-7, 0.6);
  std::vector<double> grains(5000);
  for (double& grain : grains) grain = sizes(random);
  const Grading grading = Grading::from_grains(grains);
  double last = 0;
  for (const GradingPoint& point : grading.curve()) {
    CHECK(point.finer >= last);
    last = point.finer;
  }
  CHECK(last == 1);
  for (double share = 0.05; share < 1; share += 0.05)
    CHECK(grading.finer_at(grading.diameter_at(share)) ==
          Approx(share).margin(1e-9));  // both interpolate alike
  double mass = 0;
  for (const GradingClass& one : grading.classes(30)) mass += one.mass;
  CHECK(mass == Approx(1));
}

TEST_CASE("H and F of a straight line follow from its slope") {
  // H = ln 4/ln 100 of the mass wherever 4d is within the grading.
  const Grading line = Grading::from_curve(std::vector<GradingPoint>{{1e-4, 0}, {1e-2, 1}});
  const auto points = shape_curve(line, 0.2);
  REQUIRE_FALSE(points.empty());
  for (const ShapePoint& point : points) CHECK(point.interval == Approx(std::log(4) / std::log(100)));
  CHECK(points.back().finer == Approx(0.2));
}

TEST_CASE("a class that the split meets goes to both sides") {
  const std::vector<GradingClass> classes{{1e-3, 0.5}, {2e-3, 0.5}};
  const auto [fine, coarse] = split_classes(classes, 0.75);
  REQUIRE(fine.size() == 2);
  CHECK(fine[1].mass == Approx(0.25 / 0.75));
  REQUIRE(coarse.size() == 1);
  CHECK(coarse[0].mass == Approx(1));
}

TEST_CASE("bad gradings are refused in one line that names the size") {
  CHECK_THAT(refusal({}), Catch::Contains("at least one"));
  CHECK_THAT(refusal({{1e-3, -0.5}, {2e-3, 1.5}}), Catch::Contains("mass of the class at 0.001 m = -0.5"));
  CHECK_THAT(refusal({{1e-3, std::nan("")}, {2e-3, 1}}), Catch::Contains("nan"));
  CHECK_THAT(refusal({{2e-3, 0.5}, {1e-3, 0.5}}), Catch::Contains("sort"));
  CHECK_THAT(refusal({{-1e-3, 0.5}, {1e-3, 0.5}}), Catch::Contains("positive"));
  CHECK_THAT(curve_refusal({{1e-3, 0}, {2e-3, 0.8}}), Catch::Contains("100 %"));
  CHECK_THAT(curve_refusal({{1e-3, 0.5}, {2e-3, 0.4}, {3e-3, 1}}), Catch::Contains("cumulative"));
  CHECK_THAT(curve_refusal({{1e-3, 0}, {2e-3, 80}}), Catch::Contains("between 0 and 100"));
  CHECK_THROWS_AS(Grading::from_grains(std::vector<double>{1e-3, std::nan("")}), UserError);
}

TEST_CASE("below the end of a curve nothing is defined, and above it everything is as before") {
  // The sieves of a soil with 33 % finer than the last: its d50 does not depend on what passes that.
  const Grading cut = Grading::from_curve(std::vector<GradingPoint>{{1e-4, 0.33}, {4e-4, 0.5}, {2e-3, 1}});
  CHECK(cut.unknown_below() == Approx(0.33));
  CHECK(cut.smallest() == 1e-4);
  CHECK(cut.diameter_at(0.33) == Approx(1e-4));
  CHECK(cut.diameter_at(0.5) == Approx(4e-4));
  CHECK(std::isnan(cut.diameter_at(0.32)));
  CHECK(std::isnan(cut.diameter_above(0.1)));
  CHECK(std::isnan(cut.finer_at(0.9e-4)));
  CHECK(std::isnan(cut.finer_below(0.9e-4)));
  CHECK(std::isnan(cut.finer_at(std::nan(""))));
  CHECK(cut.finer_below(1e-4) == Approx(0.33));
  const GradingIndices indices = grading_indices(cut);
  CHECK(std::isnan(indices.d10));
  CHECK(std::isnan(indices.uniformity));
  CHECK(std::isnan(indices.sauter));
  CHECK(indices.d85 == Approx(4e-4 * std::pow(5, 0.7)));
  CHECK_THROWS_AS(cut.classes(), UserError);
  CHECK(curve_end(cut) == "the curve ends at 0.1 mm with 33 % finer");
  CHECK(Grading::from_curve(std::vector<GradingPoint>{{1e-4, 0}, {2e-3, 1}}).unknown_below() == 0);
}

TEST_CASE("a flat stretch at the unknown end of a curve is no gap, since nobody knows how wide it is") {
  const Grading open =
      Grading::from_curve(std::vector<GradingPoint>{{1e-4, 0.30}, {3e-4, 0.31}, {4e-4, 0.315}, {2e-3, 1}});
  CHECK_FALSE(open.gap());
  CHECK(Grading::from_curve(std::vector<GradingPoint>{{0.5e-4, 0}, {1e-4, 0.30}, {3e-4, 0.31}, {2e-3, 1}})
            .gap());
}
