// k of each sphere from its diameter and the pores around it: the law, the survey of the pores on any number
// of ranks, and when a survey is made.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "prescribed_grains.h"
#include "random_packing.h"
#include "suffuse/common/error.h"
#include "suffuse/coupling/coupled_simulation.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

constexpr CoefficientLaw kReadsCrowding{1, 0, 1, 0};  ///< x from k = 1 + x/D

CoupledSettings cells_as_metres() {
  CoupledSettings settings;
  settings.units.density = 1;
  settings.units.viscosity = 0.1;
  settings.units.spacing = 1;
  settings.units.time_step = 1;
  settings.substeps = 1;
  return settings;
}

std::vector<PrescribedGrains::Grain> grains_at(const std::vector<Vec3>& centres,
                                               const std::vector<double>& radii) {
  std::vector<PrescribedGrains::Grain> list;
  for (std::size_t n = 0; n < centres.size(); ++n) {
    PrescribedGrains::Grain g;
    g.position = centres[n];
    g.radius = radii[n];
    list.push_back(g);
  }
  return list;
}

struct Bed {
  lbm::Index3 cells;
  PackingRequest request;
  std::vector<Vec3> centres;

  Bed(int edge, double phi, std::vector<double> radii, std::array<bool, 3> periodic = {true, true, true})
      : cells{edge, edge, edge} {
    request.box = Vec3::Constant(edge);
    request.periodic = periodic;
    const double scale = std::cbrt(phi * edge * edge * edge / volume_of(radii));
    for (double& r : radii) r *= scale;
    request.radii = radii;
    centres = random_packing(request);
  }

  /// x of each grain, in a box that goes on for `water` cells above and below without grains.
  std::vector<double> crowding(int water = 0) const {
    CoupledSettings settings = cells_as_metres();
    settings.solids.law = kReadsCrowding;
    lbm::Index3 whole = cells;
    whole[2] += 2 * water;
    for (int face = 0; face < 6; ++face)
      if (!request.periodic[static_cast<std::size_t>(face / 2)])
        settings.fluid.faces[static_cast<std::size_t>(face)].kind = lbm::FaceKind::no_slip;
    auto list = grains_at(centres, request.radii);
    for (auto& g : list) g.position[2] += water;
    PrescribedGrains grains(list, Vec3(whole[0], whole[1], whole[2]), request.periodic, 1.);
    CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, whole), Vec3::Zero(),
                                 grains);
    simulation.map();
    std::vector<double> x;
    for (std::size_t n = 0; n < list.size(); ++n)
      x.push_back((simulation.coefficient_of(n) - 1) * 2 * list[n].radius);
    return x;
  }
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("The coefficient falls with resolution and rises with crowding") {
  for (const auto o : {lbm::SolidOperator::force, lbm::SolidOperator::sc3}) {
    const CoefficientLaw law = coefficient_law(o);
    for (const double x : {0., 0.3, 0.8, 1.5, 2.5})
      for (double d = 2; d < 60; d *= 1.3) {
        CHECK(law(d, x) >= law(1.3 * d, x));
        CHECK(law(d, x + 0.1) >= law(d, x));
        CHECK(law(d, x) > law.constant);
        CHECK(law(d, x) <= kLargestCoefficient);
      }
    CHECK(law(1e6, 1.5) == Approx(law.constant).epsilon(1e-4));
    CHECK(law(10, 50) == law(10, 3));  // not extrapolated beyond close packing
  }
  CHECK_THROWS_AS(coefficient_law(lbm::SolidOperator::sc1), UserError);
  CHECK_THROWS_AS(coefficient_law(lbm::SolidOperator::sc2), UserError);
}

TEST_CASE("A dense packing's crowding is 0.75 phi/(1 - phi), a lone sphere has none") {
  // Pores fill 0.4 to 0.45 of the ball, of 0.55 to 0.6 with the share that is added; and within a ball of two
  // radii the solid fraction of a random packing of 16 is not that of the box: 20 % together.
  const double phi = GENERATE(0.5, 0.6);
  const double expected = 0.75 * phi / (1 - phi);
  CHECK(mean(Bed(24, phi, std::vector<double>(16, 1.)).crowding()) == Approx(expected).epsilon(0.2));
  Bed alone(24, 0.005, {1.});
  CHECK(alone.crowding()[0] == 0);
}

TEST_CASE("Open water above and below, or walls, hardly thin out what a bed's grains see") {
  // Sixteen grains in a layer of 2.4 diameters: nearly all are at an edge of it. Without the rule that a pore
  // lies between two spheres the water would take x down to half.
  const Bed bed(24, 0.58, std::vector<double>(16, 1.));
  const double inside = mean(bed.crowding()), edge = mean(bed.crowding(12));
  CHECK(edge < inside);
  CHECK(edge > 0.85 * inside);
  const Bed walled(36, 0.45, std::vector<double>(27, 1.), {false, false, false});
  CHECK(mean(walled.crowding()) > 0.9 * 0.75 * 0.45 / 0.55);
}

TEST_CASE("Coefficients do not depend on the number of ranks") {
  std::vector<double> radii = spread_radii(20, 0.4);
  radii[3] = 2.5;  // one that spans ranks
  const Bed bed(30, 0.5, radii);
  const std::vector<double> x = bed.crowding();

  // The same on this rank alone, its copies added up here.
  CoupledSettings settings = cells_as_metres();
  settings.solids.cells.own_coefficients = true;
  settings.fluid.collision.relaxation_time = 0.8;
  lbm::Fluid fluid(settings.fluid, lbm::Decomposition::balanced(MPI_COMM_SELF, bed.cells));
  const lbm::PartialSolidArrays arrays = fluid.use_partial_solids(settings.solids.cells);
  SolidMapping mapping(settings.solids, fluid.instruction_set(), arrays, fluid.decomposition().local_box());
  PoreSurvey survey(fluid.instruction_set(), arrays, fluid.decomposition().local_box());
  PrescribedGrains grains(grains_at(bed.centres, bed.request.radii), bed.request.box, {true, true, true}, 1.);
  const GrainArrays all = grains.grains();
  std::vector<LatticeSphere> spheres(static_cast<std::size_t>(all.total));
  for (int n = 0; n < all.total; ++n) {
    LatticeSphere& s = spheres[static_cast<std::size_t>(n)];
    for (int a = 0; a < 3; ++a) s.position[a] = all.position[3 * n + a];
    s.radius = all.radius[n];
    s.id = all.id[n];
  }
  mapping.update(spheres);
  std::vector<PoreSums> whole(x.size());
  const std::vector<PoreSums> parts = survey.sums(spheres);
  for (std::size_t n = 0; n < spheres.size(); ++n) {
    whole[static_cast<std::size_t>(spheres[n].id - 1)].volume += parts[n].volume;
    whole[static_cast<std::size_t>(spheres[n].id - 1)].surface += parts[n].surface;
  }
  // Round-off of sums over some thousand cells; k = 1 + x/D loses another digit.
  for (std::size_t n = 0; n < x.size(); ++n)
    CHECK(x[n] == Approx(crowding_of(whole[n], bed.request.radii[n])).epsilon(1e-11));
}

TEST_CASE("Pores are surveyed when a grain comes or has moved, and only then") {
  CoupledSettings settings = cells_as_metres();
  settings.solids.survey_every = 5;
  std::vector<PrescribedGrains::Grain> list = grains_at({Vec3(6, 8, 8), Vec3(17, 8, 8)}, {3, 3});
  list[1].velocity = Vec3(-0.04, 0, 0);
  PrescribedGrains grains(list, Vec3(30, 16, 16), {true, true, true}, 1.);
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, {30, 16, 16}),
                               Vec3::Zero(), grains);
  for (int n = 0; n < 12; ++n) simulation.step();
  CHECK(simulation.surveys() == 1);  // once, at the start
  const double apart = simulation.coefficient_of(0);
  grains.mobile = true;
  for (int n = 0; n < 100; ++n) simulation.step();
  // 0.04 cells a step pass 0.25 cells every 7 steps, and only each fifth step is asked: every 10 steps.
  CHECK(simulation.surveys() > 8);
  CHECK(simulation.surveys() < 14);
  CHECK(simulation.coefficient_of(0) > 1.1 * apart);  // the gap closed from 5 cells to one
}

TEST_CASE("A coefficient that is given stays") {
  CoupledSettings settings = cells_as_metres();
  settings.solids.automatic_coefficient = false;
  settings.solids.cells.coefficient = 3.25;
  PrescribedGrains grains(grains_at({Vec3(6, 8, 8), Vec3(12.5, 8, 8)}, {3, 3}), Vec3(30, 16, 16),
                          {true, true, true}, 1.);
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, {30, 16, 16}),
                               Vec3::Zero(), grains);
  simulation.step();
  CHECK(simulation.coefficient_of(0) == 3.25);
  CHECK(simulation.surveys() == 0);
}

TEST_CASE("Random packings do not overlap and are the same for the same request") {
  PackingRequest request;
  request.box = Vec3(20, 20, 20);
  request.periodic = {true, false, true};
  request.radii = spread_radii(60, 0.4);
  for (double& r : request.radii) r *= std::cbrt(0.5 * 8000 / volume_of(spread_radii(60, 0.4)));
  const std::vector<Vec3> once = random_packing(request), again = random_packing(request);
  CHECK(smallest_gap(request, once) >= 0);
  for (std::size_t n = 0; n < once.size(); ++n) CHECK(once[n] == again[n]);
}
