// Drag on random packings that the automatic coefficient was not fitted to, against references that the
// solver's partly covered cells had no part in, or only at three times the resolution
// (tests/data/packing_drags.csv, docs/decisions/solid-operator.md).
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <string>

#include "drag_of_packings.h"
#include "link_wise_stokes.h"
#include "packing_reference.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

/// Per cent, the mean over two places of the packing on the lattice.
double error_percent(const std::string& name, double diameter, DragRun run) {
  const Packing packing = make_packing(name);
  double sum = 0;
  for (const double offset : {0.3, 0.8}) {
    run.offset = offset;
    sum += drag_of(packing, diameter, run).drag / 2;
  }
  return 100 * (sum / testing::reference_drag(name) - 1);
}

}  // namespace

TEST_CASE(
    "Packings not fitted: drag within 3 % at five cells a Sauter diameter, the densest within 2 % at eight") {
  const std::string packing = GENERATE("random:0.2:64:31", "random:0.4:64:31", "random:0.62:64:31",
                                       "spread:0.5:64:31:0.25", "spread:0.58:64:31:0.4");
  INFO(packing);
  CHECK(std::abs(error_percent(packing, 5, {})) < 3);
  if (packing == "random:0.62:64:31") CHECK(std::abs(error_percent(packing, 8, {})) < 2);
}

TEST_CASE("Packings not fitted: drag within 2 % at eight cells a Sauter diameter", "[.long]") {
  const std::string packing =
      GENERATE("random:0.2:64:31", "random:0.4:64:31", "spread:0.5:64:31:0.25", "spread:0.58:64:31:0.4");
  INFO(packing);
  CHECK(std::abs(error_percent(packing, 8, {})) < 2);
}

TEST_CASE(
    "The worst packing known, an open channel through a dense box, is within what a plan says at most") {
  CHECK(std::abs(error_percent("random:0.5:16:11", 5, {})) < 100 * largest_permeability_error(5));
  CHECK(std::abs(error_percent("random:0.5:16:11", 8, {})) < 100 * largest_permeability_error(8));
}

TEST_CASE(
    "A packing that is carried along by five and ten viscosities a cell keeps its drag within 2.5 %, along "
    "an "
    "axis and along all three") {
  // Without the share for swept cells: +4.4 and +8.3 % along x, +7.6 and +14.2 % along (1, 1, 1).
  DragRun run;
  run.collision = lbm::CollisionOperator::trt_comoving;
  run.oblique = GENERATE(false, true);
  run.relaxation_time = GENERATE(0.53, 0.515);
  CAPTURE(run.oblique, run.relaxation_time);
  const MovingResult result = moving_drag_of(make_packing("random:0.58:16:1"), 5, run, 0.05, 2e-4);
  REQUIRE(result.stable);
  CHECK(std::abs(result.drag / result.held - 1) < 0.025);
}

TEST_CASE("Gap-graded packings not fitted: drag within 3 % at eight cells, where fines have two to four") {
  const std::string packing = GENERATE("gap:0.62:6:31:3:0.3", "gap:0.6:8:31:5:0.1", "gap:0.65:4:31:4:0.35");
  INFO(packing);
  CHECK(std::abs(error_percent(packing, 8, {})) < 3);
}

TEST_CASE(
    "A settled gap-graded sample: drag within 5 % at five and at eight cells, where fines have half of it") {
  // Scene 01, A30, 400 grains, porosity 0.25. K: 450 at 24 cells of this lattice, where it still falls; 459
  // at 20 by the second method, where it still rises.
  constexpr double drag = 455;
  const Packing sample = make_packing("dump:" SUFFUSE_TEST_DATA "/settled_A30.dump");
  REQUIRE(sample.radii.size() == 400);
  const double cells = GENERATE(5., 8.);
  const DragResult result = drag_of(sample, cells, {});
  CHECK(result.phi == Approx(0.750).epsilon(0.002));
  CHECK(result.drag == Approx(drag).epsilon(0.05));
}

TEST_CASE("A coarse lattice errs by as much as a plan says, and about as a rule") {
  for (const double cells : {2.5, 3., 4.}) {
    double squares = 0;
    constexpr const char* packings[] = {"random:0.4:64:31", "random:0.58:64:31", "random:0.62:64:31",
                                        "spread:0.58:64:31:0.4", "appendix_c:0.6:11"};
    for (const char* packing : packings) {
      const double error = error_percent(packing, cells, {});
      CAPTURE(packing, cells);
      CHECK(std::abs(error) < 100 * largest_permeability_error(cells));
      squares += error * error / std::size(packings);
    }
    CAPTURE(cells);
    CHECK(std::sqrt(squares) > 40 * expected_permeability_error(cells));
    CHECK(std::sqrt(squares) < 160 * expected_permeability_error(cells));
  }
}

TEST_CASE("The expected error of a permeability falls with resolution down to the references' own") {
  for (double d = 1; d < 60; d *= 1.2) {
    CHECK(expected_permeability_error(1.2 * d) <= expected_permeability_error(d));
    CHECK(largest_permeability_error(d) > expected_permeability_error(d));
    CHECK(expected_permeability_error(d) > 0.005);
  }
}

TEST_CASE("The law of sc3 on packings not fitted, at five cells") {
  DragRun run;
  run.solid_operator = lbm::SolidOperator::sc3;
  run.relaxation_time = 0.8;
  // Its largest error on these: 3.1 % at one place on the lattice.
  CHECK(std::abs(error_percent("random:0.4:64:31", 5, run)) < 3.5);
  CHECK(std::abs(error_percent("spread:0.58:64:31:0.4", 5, run)) < 3.5);
}

TEST_CASE("A second method gives Zick & Homsy's drag: links that end on the spheres") {
  // c = 0.216 simple cubic, K = 7.442: 0.25 % off at 16 cells; half-way links 3 %, since spheres are then
  // steps of cells.
  const Packing array = array_packing(0.216, false);
  CHECK(link_wise_drag(array, 16, LinkRule::interpolated, 0.3).drag == Approx(7.442).epsilon(0.005));
  CHECK(link_wise_drag(array, 16, LinkRule::halfway, 0.3).drag == Approx(7.442).epsilon(0.05));
}

namespace {

// A bed of 2.4 diameters between layers of water. K through the bed at 16 cells (by the same method: the
// reference is the lattice's own limit); packings 29 and 39 cells wide at 12 and 16 cells a diameter differ
// by 0.3 to 1.3 %. Measured at five cells +2.6, -1.2 and +2.5 %, mean of two places; set after that, as the
// aim for thick beds is 3 %.
constexpr double kThinBedDrags[] = {71.578, 61.523, 50.931};

/// A share of that of packing `seed`, mean over two places on the lattice.
double error_of_thin_bed(int seed, double diameter) {
  DragRun run;
  run.water = 1;
  run.through = true;
  double sum = 0;
  for (const double offset : {0.3, 0.7}) {
    run.offset = offset;
    sum += drag_of(make_packing("random:0.6:16:" + std::to_string(seed)), diameter, run).drag / 2;
  }
  return sum / kThinBedDrags[seed - 1] - 1;
}

}  // namespace

TEST_CASE("A bed of 2.4 diameters between layers of water has the drag of a lattice three times finer") {
  const int seed = GENERATE(1, 2, 3);
  INFO("packing " << seed);
  CHECK(std::abs(error_of_thin_bed(seed, 5)) < 0.04);
}

TEST_CASE("A bed of 2.4 diameters has the drag of a lattice twice as fine", "[.long]") {
  const int seed = GENERATE(1, 2, 3);
  INFO("packing " << seed);
  CHECK(std::abs(error_of_thin_bed(seed, 8)) < 0.025);
}
