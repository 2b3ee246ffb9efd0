// k in each cell from the sphere's diameter and the pores around the cell: the law, the survey of the pores
// on any number of ranks, and when a survey is made.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "prescribed_grains.h"
#include "random_packing.h"
#include "suffuse/common/error.h"
#include "suffuse/coupling/coupled_simulation.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

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

  PrescribedGrains grains(MPI_Comm communicator = MPI_COMM_WORLD) const {
    return {grains_at(centres, request.radii), request.box, request.periodic, 1., communicator};
  }
};

/// k in a cell, wherever it is.
double coefficient_in(const CoupledSimulation& simulation, const lbm::Index3& cell) {
  const lbm::CellBox& box = simulation.fluid().decomposition().local_box();
  bool here = true;
  for (std::size_t a = 0; a < 3; ++a) here &= cell[a] >= box.lo[a] && cell[a] < box.hi[a];
  double k = here ? simulation.solid_coefficient(cell) : 0;
  MPI_Allreduce(MPI_IN_PLACE, &k, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return k;
}

/// Points that are spread evenly over the unit sphere.
std::vector<Vec3> directions(int count) {
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) {
    const double z = 1 - (2 * n + 1.) / count, turn = n * std::numbers::pi * (3 - std::sqrt(5.));
    points.push_back(Vec3(std::cos(turn) * std::sqrt(1 - z * z), std::sin(turn) * std::sqrt(1 - z * z), z));
  }
  return points;
}

struct Seen {
  double surface = 0, solid = 0;
};

/// What a window of that range sees of a sphere, by summing it over points on and in the sphere.
Seen seen_through(double range, const Vec3& place, const LatticeSphere& s) {
  static const std::vector<Vec3> points = directions(4000);
  const Vec3 centre(s.position[0], s.position[1], s.position[2]);
  const double r = s.radius, share = 4 * std::numbers::pi / static_cast<double>(points.size());
  const auto window = [&](const Vec3& point) {
    const double t = (place - point).norm() / range;
    return t < 1 ? 15 / (8 * std::numbers::pi * range * range * range) * (1 - t * t) : 0;
  };
  Seen seen;
  constexpr int shells = 40;
  for (const Vec3& n : points) {
    seen.surface += share * r * r * window(centre + r * n);
    for (int i = 0; i < shells; ++i) {
      const double at = r * (i + 0.5) / shells;
      seen.solid += share * at * at * (r / shells) * window(centre + at * n);
    }
  }
  return seen;
}

/// Surface per volume of pore at a place; `reach` as CoefficientTerms has it.
double summed_surface_per_pore(const Vec3& place, const std::vector<LatticeSphere>& spheres,
                               double reach = 0) {
  double surfaces = 0, radii = 0;
  for (const LatticeSphere& s : spheres) {
    const double surface = seen_through(s.radius, place, s).surface;
    surfaces += surface;
    radii += surface * s.radius;
  }
  Seen all;
  for (const LatticeSphere& s : spheres) {
    const double range =
        reach > 0 && surfaces > 0
            ? std::min(s.radius, std::max(reach * radii / surfaces, double{PoreSurvey::kShortestRange}))
            : s.radius;
    const Seen seen = seen_through(range, place, s);
    all.surface += seen.surface;
    all.solid += seen.solid;
  }
  return all.surface / (std::max(0., 1 - all.solid) + PoreSurvey::kOpenShare);
}

/// Two spheres that nearly touch and a small one in the pore beside; radii 4, 3.5 and 1.1 times `scale`,
/// cells.
std::vector<LatticeSphere> two_and_a_small_one(double scale) {
  const double centres[3][3] = {{8.2, 9.7, 10.1}, {15.9, 10.4, 9.6}, {11.8, 12.9, 12.2}},
               radii[3] = {4, 3.5, 1.1};
  std::vector<LatticeSphere> spheres(3);
  for (std::size_t n = 0; n < 3; ++n) {
    for (int a = 0; a < 3; ++a) spheres[n].position[a] = scale * centres[n][a];
    spheres[n].radius = scale * radii[n];
  }
  return spheres;
}

}  // namespace

TEST_CASE("The coefficient falls with resolution and rises with crowding") {
  for (const auto o : {lbm::SolidOperator::force, lbm::SolidOperator::sc3}) {
    const CoefficientLaw law = coefficient_law(o);
    for (double d = 2; d < 60; d *= 1.3) {
      CHECK(law.of_sphere(d) > law.of_sphere(1.3 * d));
      CHECK(law.of_sphere(d) > law.constant);
    }
    CHECK(law.of_pore(0) == 0);
    for (const double surface : {0., 0.1, 0.3, 0.8, 1.5})
      CHECK(law.of_pore(surface + 0.1) > law.of_pore(surface));
    CHECK(law.of_sphere(1e6) == Approx(law.constant).epsilon(1e-4));
  }
  CHECK_THROWS_AS(coefficient_law(lbm::SolidOperator::sc1), UserError);
  CHECK_THROWS_AS(coefficient_law(lbm::SolidOperator::sc2), UserError);
}

TEST_CASE(
    "The coefficient of a sphere that moves falls by what its surfaces sweep, and is the law's at rest") {
  const CoefficientLaw law = coefficient_law(lbm::SolidOperator::force);
  CHECK(law.share_at(0) == 1);
  CHECK(law.share_at(10) == Approx(1 / 1.12).epsilon(1e-12));
  CHECK(coefficient_law(lbm::SolidOperator::sc3).share_at(10) == 1);  // not fitted
  // 0.05 and 0.02 cells a step along x and y, viscosity 0.1: 0.7 viscosities a cell; the sign does not
  // matter.
  const auto in_the_middle = [](const Vec3& velocity) {
    std::vector<PrescribedGrains::Grain> list = grains_at({Vec3(8.5, 8.5, 8.5)}, {3});
    list[0].velocity = velocity;
    PrescribedGrains grains(list, Vec3(17, 17, 17), {true, true, true}, 1.);
    CoupledSimulation simulation(
        cells_as_metres(), lbm::Decomposition::balanced(MPI_COMM_WORLD, {17, 17, 17}), Vec3::Zero(), grains);
    simulation.map();
    return coefficient_in(simulation, {8, 8, 8});
  };
  const double still = in_the_middle(Vec3::Zero());
  for (const double sign : {-1., 1.})  // strengths are multiples of 2^-14
    CHECK(in_the_middle(sign * Vec3(0.05, -0.02, 0)) == Approx(still * law.share_at(0.7)).epsilon(1e-4));
}

TEST_CASE("The surface per volume of pore is what a sum over points on and in the spheres gives") {
  CoupledSettings settings = cells_as_metres();
  settings.fluid.collision.relaxation_time = 0.8;
  settings.solids.cells.own_coefficients = true;
  lbm::Fluid fluid(settings.fluid, lbm::Decomposition::balanced(MPI_COMM_SELF, {24, 20, 20}));
  const lbm::PartialSolidArrays arrays = fluid.use_partial_solids(settings.solids.cells);
  const std::vector<LatticeSphere> spheres = two_and_a_small_one(1);
  PoreSurvey survey(fluid.instruction_set(), arrays, fluid.decomposition().local_box());
  survey.update(spheres, {0, 0, 6, 0});  // k = s
  const auto found = [&](int x, int y, int z) {
    return survey.coefficients()[x + arrays.row_pitch * y + arrays.plane_pitch * z];
  };
  for (const lbm::Index3& cell :
       {lbm::Index3{12, 10, 10}, {11, 11, 11}, {8, 14, 10}, {4, 9, 9}, {15, 6, 9}, {8, 9, 10}}) {
    const Vec3 place(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5);
    // The smallest sphere's shells are the coarsest: 1 % of its volume.
    CHECK(found(cell[0], cell[1], cell[2]) == Approx(summed_surface_per_pore(place, spheres)).epsilon(0.01));
  }
  CHECK(found(22, 18, 18) == 0);  // farther than a diameter from all
  survey.update(spheres, {7, 9, 6, 36});
  const float s = static_cast<float>(summed_surface_per_pore(Vec3(12.5, 10.5, 10.5), spheres));
  CHECK(found(12, 10, 10) == Approx(s + s * s).epsilon(0.02));  // of the pore alone: no constant, no diameter
  survey.update(spheres, {7, 9, 6, 36, 1296});
  CHECK(found(12, 10, 10) == Approx(s + s * s + s * s * s * s).epsilon(0.04));
}

TEST_CASE(
    "Large spheres are seen from as near as a small one between them, but not from nearer than some cells") {
  for (const int scale : {1, 4}) {
    CoupledSettings settings = cells_as_metres();
    settings.fluid.collision.relaxation_time = 0.8;
    settings.solids.cells.own_coefficients = true;
    lbm::Fluid fluid(settings.fluid,
                     lbm::Decomposition::balanced(MPI_COMM_SELF, {24 * scale, 20 * scale, 20 * scale}));
    const lbm::PartialSolidArrays arrays = fluid.use_partial_solids(settings.solids.cells);
    const std::vector<LatticeSphere> spheres = two_and_a_small_one(scale);
    PoreSurvey survey(fluid.instruction_set(), arrays, fluid.decomposition().local_box());
    survey.update(spheres, {0, 0, 6, 0, 0, 0.9});  // k = s
    for (const lbm::Index3& cell : {lbm::Index3{12, 13, 12}, {11, 13, 13}, {10, 12, 11}}) {
      const int x = cell[0] * scale + scale / 2, y = cell[1] * scale + scale / 2,
                z = cell[2] * scale + scale / 2;
      const Vec3 place(x + 0.5, y + 0.5, z + 0.5);
      const double wanted = summed_surface_per_pore(place, spheres, 0.9),
                   own_ranges = summed_surface_per_pore(place, spheres);
      CAPTURE(scale, x, y, z);
      CHECK((std::abs(wanted / own_ranges - 1) > 0.05) == (scale > 1));
      CHECK(survey.coefficients()[x + arrays.row_pitch * y + arrays.plane_pitch * z] ==
            Approx(wanted).epsilon(0.02));
    }
  }
}

TEST_CASE("Among equal spheres the window is their radius, however far it might reach") {
  CoupledSettings settings = cells_as_metres();
  settings.fluid.collision.relaxation_time = 0.8;
  settings.solids.cells.own_coefficients = true;
  const Bed bed(24, 0.5, std::vector<double>(16, 1.));
  lbm::Fluid fluid(settings.fluid, lbm::Decomposition::balanced(MPI_COMM_SELF, bed.cells));
  const lbm::PartialSolidArrays arrays = fluid.use_partial_solids(settings.solids.cells);
  std::vector<LatticeSphere> spheres(16);
  for (std::size_t n = 0; n < spheres.size(); ++n) {
    for (int a = 0; a < 3; ++a) spheres[n].position[a] = bed.centres[n][a];
    spheres[n].radius = bed.request.radii[n];
  }
  PoreSurvey survey(fluid.instruction_set(), arrays, fluid.decomposition().local_box());
  survey.update(spheres, {0, 0, 6, 0});
  const std::vector<float> without = survey.values();
  // A hair's breadth of difference makes it look at both.
  spheres[5].radius *= 1 + 1e-6;
  survey.update(spheres, {0, 0, 6, 0, 0, 1.7});
  const std::vector<float> with = survey.values();
  double largest = 0;
  for (std::size_t n = 0; n < with.size(); ++n)
    largest = std::max(largest, static_cast<double>(std::abs(with[n] - without[n])));
  CHECK(largest < 1e-3);
  CHECK(*std::max_element(with.begin(), with.end()) > 0.5);
}

TEST_CASE("Coefficients are the same to the last digit on any number of ranks") {
  std::vector<double> radii = spread_radii(20, 0.4);
  radii[3] = 2.5;  // one that spans ranks
  const Bed bed(30, 0.5, radii);
  PrescribedGrains everywhere = bed.grains(), here = bed.grains(MPI_COMM_SELF);
  CoupledSimulation shared(cells_as_metres(), lbm::Decomposition::balanced(MPI_COMM_WORLD, bed.cells),
                           Vec3::Zero(), everywhere);
  CoupledSimulation alone(cells_as_metres(), lbm::Decomposition::balanced(MPI_COMM_SELF, bed.cells),
                          Vec3::Zero(), here);
  shared.map();
  alone.map();
  double covered = 0, different = 0;
  lbm::for_each_cell(shared.fluid().decomposition().local_box(), [&](int x, int y, int z) {
    covered += shared.solid_coefficient({x, y, z}) > 0 ? 1 : 0;
    different += shared.solid_coefficient({x, y, z}) != alone.solid_coefficient({x, y, z}) ? 1 : 0;
  });
  CHECK(covered > 500);
  CHECK(different == 0);
}

TEST_CASE("Pores are surveyed when a grain comes or has moved, and only then") {
  CoupledSettings settings = cells_as_metres();
  settings.solids.survey_every = 5;
  settings.solids.survey_distance = 0.25;
  std::vector<PrescribedGrains::Grain> list = grains_at({Vec3(6, 8, 8), Vec3(17, 8, 8)}, {3, 3});
  list[1].velocity = Vec3(-0.04, 0, 0);
  PrescribedGrains grains(list, Vec3(30, 16, 16), {true, true, true}, 1.);
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, {30, 16, 16}),
                               Vec3::Zero(), grains);
  for (int n = 0; n < 12; ++n) simulation.step();
  CHECK(simulation.surveys() == 1);   // once, at the start
  const lbm::Index3 facing{8, 8, 8};  // the side of the first that the second comes to
  const double apart = coefficient_in(simulation, facing);
  grains.mobile = true;
  for (int n = 0; n < 100; ++n) simulation.step();
  // 0.04 cells a step pass 0.25 cells every 7 steps, and only each fifth step is asked: every 10 steps.
  CHECK(simulation.surveys() > 8);
  CHECK(simulation.surveys() < 14);
  CHECK(coefficient_in(simulation, facing) > 1.1 * apart);  // the gap closed from 5 cells to one
  const long before = simulation.surveys();
  grains.mobile = false;
  simulation.step();
  CHECK(simulation.surveys() == before);
  grains.erase(1);
  simulation.step();
  CHECK(simulation.surveys() == before + 1);  // and when one goes
  CHECK(coefficient_in(simulation, facing) < apart + 1e-6);
}

TEST_CASE("Coefficients of grains that may move are cut by what they weigh") {
  const auto largest_in = [](CoupledSimulation& simulation) {
    double largest = 0;
    lbm::for_each_cell(simulation.fluid().decomposition().local_box(), [&](int x, int y, int z) {
      largest = std::max(largest, simulation.solid_coefficient({x, y, z}));
    });
    return largest;
  };
  CoupledSettings settings = cells_as_metres();
  settings.solids.law = CoefficientLaw{{2, 0, 1e6, 0}};
  std::vector<PrescribedGrains::Grain> list = grains_at({Vec3(6, 8, 8), Vec3(20, 8, 8)}, {2, 0.9});
  for (PrescribedGrains::Grain& grain : list) grain.density = 2.65 * settings.units.density;
  PrescribedGrains grains(list, Vec3(30, 16, 16), {true, true, true}, 1.);
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_SELF, {30, 16, 16}),
                               Vec3::Zero(), grains);
  simulation.map();
  CHECK(largest_in(simulation) == Approx(42 * 2.15).epsilon(1e-3));
  EffectSettings held;
  held.motion = Switch::off;
  simulation.set_effects(held);
  simulation.map();
  CHECK(largest_in(simulation) == Approx(kLargestCoefficient).epsilon(1e-3));
  CHECK(coefficient_in(simulation, {20, 8, 8}) == Approx(kSafeCoefficient).epsilon(1e-3));
  simulation.set_effects({});
  simulation.map();
  CHECK(largest_in(simulation) == Approx(42 * 2.15).epsilon(1e-3));
  grains.list[0].density *= 2;  // another grain, for all its size says
  simulation.map();
  CHECK(largest_in(simulation) == Approx(42 * 4.8).epsilon(1e-3));

  constexpr double quartz = 2.65, nothing_moves_it = std::numeric_limits<double>::infinity();
  CHECK(largest_coefficient(0.9, nothing_moves_it) == kSafeCoefficient);
  CHECK(largest_coefficient(1, nothing_moves_it) == kLargestCoefficient);
  CHECK(largest_coefficient(2.8, quartz) == Approx(42 * 2.15));
  CHECK(largest_coefficient(4, quartz) == Approx(5.1 * 16 * 2.15));
  CHECK(largest_coefficient(5, quartz) == kLargestCoefficient);
  CHECK(largest_coefficient(1, 1.2) == Approx(42 * 0.7));
  CHECK(largest_coefficient(1, 0.3) == Approx(10));
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
  CHECK(coefficient_in(simulation, {3, 8, 8}) == 3.25);
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
