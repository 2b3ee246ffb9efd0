// The budgets that guards watch: closed to round-off while grains move in any precision, and ended where
// water or momentum is gone that nobody has taken.
#include <catch2/catch.hpp>
#include <random>

#include "commands/run_guards.h"
#include "prescribed_grains.h"
#include "suffuse/common/error.h"
#include "suffuse/common/processor_time.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

constexpr double kSpacing = 1e-4;
constexpr int kCells = 16;

CoupledSettings water(lbm::Precision precision) {
  CoupledSettings settings;
  settings.units.density = 1000;
  settings.units.viscosity = 1e-6;
  settings.units.spacing = kSpacing;
  settings.units.relaxation_time = 0.6;
  settings.substeps = 1;
  settings.fluid.precision = precision;
  settings.pressure_gradient = Vec3(0, 0, 20);
  return settings;
}

/// Free grains in a periodic box through which a gradient drives the water.
struct Bed {
  explicit Bed(const CoupledSettings& settings)
      : grains(list_of(), kSpacing * Vec3(kCells, kCells, kCells), {true, true, true},
               lbm::Units(settings.units).time_step(), MPI_COMM_SELF),
        simulation(settings, lbm::Decomposition::balanced(MPI_COMM_SELF, {kCells, kCells, kCells}),
                   Vec3::Zero(), grains) {
    grains.mobile = grains.free = true;
  }
  static std::vector<PrescribedGrains::Grain> list_of() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<PrescribedGrains::Grain> list(4);
    for (auto& g : list) {
      g.position = kCells * kSpacing * Vec3(unit(random), unit(random), unit(random));
      g.velocity = 0.01 * Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
      g.radius = 2.5 * kSpacing;
    }
    return list;
  }
  GuardReading reading() const {
    GuardReading now;
    now.fluid = simulation.extremes();
    read_budgets(now, simulation);
    return now;
  }
  void steps(int count) {
    for (int n = 0; n < count; ++n) simulation.step();
  }
  void add(int direction, double value) {
    const lbm::Index3 cell{3, 4, 5};
    simulation.fluid().set_population(direction, cell,
                                      simulation.fluid().population(direction, cell) + value);
  }
  PrescribedGrains grains;
  CoupledSimulation simulation;
};

GuardLimits limits_of(double share) {
  GuardLimits limits;
  limits.mass = limits.momentum = share;
  return limits;
}

std::string why_ended(RunGuards& guards, const Bed& bed) {
  try {
    (void)guards.check(bed.reading());
  } catch (const LostRun& end) {
    return end.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Budgets of water and grains close to round-off") {
  const auto precision = GENERATE(lbm::Precision::double_precision, lbm::Precision::float_precision);
  // Rounding of one number is 1e-16 or 6e-8; over 300 steps of 4096 cells that is what is left of the sums,
  // at 20 times what was seen.
  const double share = precision == lbm::Precision::double_precision ? 1e-13 : 1e-5;
  Bed bed(water(precision));
  RunGuards guards(limits_of(share), bed.simulation);
  bed.simulation.map();
  CHECK(guards.check(bed.reading()).empty());
  for (int n = 0; n < 3; ++n) {
    bed.steps(101);
    const GuardReading now = bed.reading();
    REQUIRE(now.momentum);
    CHECK(now.momentum->handed_over > 0);
    CHECK(why_ended(guards, bed) == "");
  }
  CHECK(guards.warned().empty());
  INFO("share missing " << bed.reading().momentum->surplus.norm() / bed.reading().momentum->handed_over);
  // A gradient whose impulse no one has counted would be seen: it is most of what was handed over.
  const GuardReading last = bed.reading();
  CHECK(last.momentum->surplus.norm() < share * last.momentum->handed_over);
}

TEST_CASE("A run whose water is lost or gains momentum from nowhere is ended") {
  const bool mass = GENERATE(true, false);
  Bed bed(water(lbm::Precision::double_precision));
  RunGuards guards(limits_of(1e-6), bed.simulation);
  bed.steps(20);
  const GuardReading first = bed.reading();
  CHECK(guards.check(first).empty());
  bed.steps(20);
  const GuardReading before = bed.reading();
  const double cells = kCells * kCells * kCells;
  const double missing = mass ? 1e-6 * cells
                              : 1e-6 * (before.momentum->handed_over - first.momentum->handed_over +
                                        first.momentum->stored + before.momentum->stored);
  const auto lose = [&](double share) {
    bed.add(mass ? 0 : 1, (mass ? 1 : 0.5) * share * missing);
    if (!mass) bed.add(2, -0.5 * share * missing);  // the opposite direction
  };
  lose(0.4);
  CHECK(guards.check(bed.reading()).empty());
  lose(0.4);
  const auto warnings = guards.check(bed.reading());
  REQUIRE(warnings.size() == 1);
  const std::string name = mass ? "mass of the water" : "momentum of water and grains";
  CHECK_THAT(warnings[0], Catch::Matchers::Contains("warning: " + name));
  lose(0.6);
  const std::string end = why_ended(guards, bed);
  CHECK_THAT(end, Catch::Matchers::Contains("lbm run: " + name));
  CHECK_THAT(end, Catch::Matchers::Contains("stay within a share of 1e-06"));
}

TEST_CASE("What held grains take is not known until loads are formed in every step") {
  Bed bed(water(lbm::Precision::double_precision));
  GuardLimits limits;
  limits.momentum = 1e-9;
  RunGuards guards(limits, bed.simulation);
  bed.grains.mobile = false;
  for (int n = 0; n < 3; ++n) {
    bed.steps(7);
    bed.simulation.refresh_loads();
    CHECK(why_ended(guards, bed) == "");
  }
  bed.grains.mobile = true;
  bed.steps(7);
  CHECK(why_ended(guards, bed) == "");
  bed.add(3, 1e-3);
  CHECK_THAT(why_ended(guards, bed), Catch::Matchers::Contains("momentum of water and grains"));
}

TEST_CASE("Momentum is watched along axes whose faces take none up") {
  using enum lbm::FaceKind;
  CoupledSettings settings = water(lbm::Precision::double_precision);
  for (const auto& [kind, watched] :
       {std::pair{free_slip, true}, std::pair{no_slip, false}, std::pair{pressure, false}}) {
    settings.fluid.faces[4].kind = settings.fluid.faces[5].kind = kind;
    settings.pressure_gradient = kind == periodic ? Vec3(0, 0, 20) : Vec3(20, 0, 0);
    Bed bed(settings);
    RunGuards guards(limits_of(1e-12), bed.simulation);
    CHECK(guards.check(bed.reading()).empty());
    bed.steps(10);
    const GuardReading now = bed.reading();
    CHECK(now.momentum.has_value() == watched);
    CHECK(now.stored_mass.has_value() == (kind != pressure));
    if (watched) {
      CHECK(now.momentum->surplus[2] == 0);
      CHECK(guards.check(now).empty());
    }
  }
}

// unit_coupling_guards "[cost]": by processor time, in turns, so that what else runs on the machine matters
// little.
TEST_CASE("A look at every 250th step costs less than 1 % of the steps", "[.cost]") {
  CoupledSettings settings = water(lbm::Precision::double_precision);
  constexpr int cells = 64;
  std::vector<PrescribedGrains::Grain> list = Bed::list_of();
  PrescribedGrains grains(list, kSpacing * Vec3(cells, cells, cells), {true, true, true},
                          lbm::Units(settings.units).time_step(), MPI_COMM_SELF);
  grains.mobile = grains.free = true;
  CoupledSimulation simulation(settings, lbm::Decomposition::balanced(MPI_COMM_SELF, {cells, cells, cells}),
                               Vec3::Zero(), grains);
  RunGuards guards(GuardLimits{}, simulation);
  simulation.step();
  double looks = 0, steps = 0;
  for (int n = 0; n < 40; ++n) {
    const double start = processor_seconds();
    for (int k = 0; k < 4; ++k) simulation.step();
    const double middle = processor_seconds();
    GuardReading now;
    now.fluid = simulation.extremes();
    read_budgets(now, simulation);
    (void)guards.check(now);
    steps += middle - start;
    looks += processor_seconds() - middle;
  }
  const double ratio = 4 * looks / steps;
  WARN("a look costs " << ratio << " steps: " << ratio / 2.5 << " % of the time");
  CHECK(ratio < 2.5);
}
