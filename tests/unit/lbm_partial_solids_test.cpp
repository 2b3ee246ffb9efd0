// Partly covered cells: fast kernels against the plain reference, and the weightings' limits.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "lbm_test_tools.h"
#include "suffuse/lbm/reference_fluid.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

// Rows of 21 cells: a pack without any solid, full packs and a remainder for every register width.
constexpr Index3 kCells{21, 4, 5};

/// What a float holds of it. A function of its own: GCC 12 vectorises the way to float and back away.
[[gnu::noinline]] double rounded_to_float(double value) {
  return static_cast<float>(value);
}

/// Some cells clear, some whole, some over-full, moving in all directions. Rounded to what a float holds.
PartialSolidCell random_solids(const Index3& cell, double coefficient) {
  PartialSolidCell solids;
  if (cell[1] == 0 || noise(cell, 0, 5) < -0.3) return solids;
  solids.fraction = std::round(1e4 * std::abs(1.2 * noise(cell, 1, 5))) / 8192;
  solids.strength = rounded_to_float(coefficient * solids.fraction);
  for (int a = 0; a < 3; ++a)
    solids.momentum[a] = rounded_to_float(0.02 * solids.strength * noise(cell, 2 + a, 5));
  return solids;
}

constexpr int kSteps = 6;

PartialSolidCell solids_of(const Index3& cell, const PartialSolidSettings& partial) {
  return random_solids(cell, partial.own_coefficients ? 2.5 : 1);
}

/// What the plain reference has in every cell after every step: its populations, velocity and exchange. It
/// knows neither storage nor instruction sets, and takes most of the time: one run serves them all.
std::vector<double> reference_run(const FluidSettings& settings, const PartialSolidSettings& partial,
                                  const Vec3& force) {
  const CellBox box = Decomposition::balanced(MPI_COMM_SELF, kCells).local_box();
  ReferenceFluid plain(settings, kCells);
  plain.use_partial_solids(partial);
  plain.set_force(force);
  for_each_cell(box, [&](int x, int y, int z) {
    plain.set_partial_solid({x, y, z}, solids_of({x, y, z}, partial));
    for (int i = 0; i < kDirections; ++i) plain.set_population(i, {x, y, z}, random_population(i, {x, y, z}));
  });
  std::vector<double> found;
  for (int step = 0; step < kSteps; ++step) {
    plain.step();
    for_each_cell(box, [&](int x, int y, int z) {
      const Index3 cell{x, y, z};
      for (int i = 0; i < kDirections; ++i) found.push_back(plain.population(i, cell));
      const Vec3 velocity = plain.at(cell).velocity, exchange = plain.exchange(cell);
      found.insert(found.end(), velocity.data(), velocity.data() + 3);
      found.insert(found.end(), exchange.data(), exchange.data() + 3);
    });
  }
  return found;
}

double largest_difference(const FluidSettings& settings, const PartialSolidSettings& partial,
                          const Vec3& force, const std::vector<double>& reference) {
  const Decomposition whole = Decomposition::balanced(MPI_COMM_SELF, kCells);
  Fluid fast(settings, whole);
  const PartialSolidArrays arrays = fast.use_partial_solids(partial);
  fast.set_force(force);
  const auto place = [&](int x, int y, int z) { return x + arrays.row_pitch * y + arrays.plane_pitch * z; };
  for_each_cell(whole.local_box(), [&](int x, int y, int z) {
    const PartialSolidCell solids = solids_of({x, y, z}, partial);
    arrays.fraction[place(x, y, z)] = static_cast<float>(solids.fraction);
    arrays.strength[place(x, y, z)] = static_cast<float>(solids.strength);
    for (std::size_t a = 0; a < 3; ++a)
      arrays.momentum[a][place(x, y, z)] = static_cast<float>(solids.momentum[static_cast<int>(a)]);
    for (int i = 0; i < kDirections; ++i) fast.set_population(i, {x, y, z}, random_population(i, {x, y, z}));
  });
  double worst = 0;
  const auto note = [&](double difference) {
    worst = std::isfinite(difference) ? std::max(worst, std::abs(difference)) : 1e300;
  };
  const double* plain = reference.data();
  for (int step = 0; step < kSteps; ++step) {
    fast.step();
    for_each_cell(whole.local_box(), [&](int x, int y, int z) {
      const Index3 cell{x, y, z};
      for (int i = 0; i < kDirections; ++i) note(fast.population(i, cell) - *plain++);
      note((fast.at(cell).velocity - Vec3(plain[0], plain[1], plain[2])).norm());
      if (arrays.fraction[place(x, y, z)] > 0)
        for (std::size_t a = 0; a < 3; ++a)
          std::visit(
              [&](const auto& per_strength) {
                const std::ptrdiff_t at = place(x, y, z);
                note(arrays.strength[at] * per_strength[a][at] - plain[3 + a]);
              },
              arrays.exchange);
      plain += 6;
    });
    fast.for_each_point([&](const Index3& cell, const FluidPoint& point, double solid_fraction) {
      const FluidPoint alone = fast.at(cell);
      const bool same = point.density == alone.density && point.velocity == alone.velocity &&
                        solid_fraction == fast.solid_fraction(cell);
      if (!same) worst = 1e300;
    });
  }
  return plain == reference.data() + reference.size() ? worst : 1e300;
}

/// With every instruction set and storage type; how many were compared.
int compare_all(FluidSettings settings, const PartialSolidSettings& partial, const Vec3& force) {
  int compared = 0;
  const std::vector<double> reference = reference_run(settings, partial, force);
  for (const InstructionSet set : available_instruction_sets())
    for (const Precision precision : {Precision::double_precision, Precision::float_precision}) {
      settings.instruction_set = set;
      settings.precision = precision;
      INFO(name_of(settings.collision.collision_operator)
           << " " << name_of(partial.solid_operator) << " " << name_of(partial.weighting) << " "
           << name_of(set) << (partial.own_coefficients ? " own coefficients" : "")
           << (settings.collision.incompressible ? " incompressible" : "")
           << (force.isZero() ? "" : " forced")
           << (precision == Precision::float_precision ? " float" : " double"));
      // As for fluid alone (lbm_kernels_test.cpp), and velocities 20 times a population.
      const double tolerance = precision == Precision::double_precision ? 4e-15 : 1e-6;
      CHECK(largest_difference(settings, partial, force, reference) < tolerance);
      ++compared;
    }
  return compared;
}

}  // namespace

TEST_CASE("partly covered cells: fast kernels equal the reference for every operator and weighting") {
  int compared = 0;
  for (const CollisionFacts& collision : kCollisionOperators)
    for (const SolidFacts& solid : kSolidOperators)
      for (const SolidWeighting weighting : {SolidWeighting::fraction, SolidWeighting::noble_torczynski,
                                             SolidWeighting::viscosity_independent})
        for (int options = 0; options < 8; ++options) {
          const bool own = (options & 4) != 0;
          if (own && weighting != SolidWeighting::viscosity_independent) continue;
          FluidSettings settings;
          settings.faces = by_axis(FaceKind::periodic, FaceKind::no_slip, FaceKind::free_slip);
          settings.collision.collision_operator = collision.collision_operator;
          settings.collision.relaxation_time = 0.7;
          settings.collision.incompressible = (options & 1) != 0;
          const Vec3 force = (options & 2) != 0 ? Vec3(1e-3, -2e-3, 5e-4) : Vec3::Zero();
          compared += compare_all(settings, {solid.solid_operator, weighting, 1.7, own}, force);
        }
  CHECK(compared >= 400);
}

TEST_CASE(
    "weightings of partly covered cells are 0 in clear cells and largest in whole ones, and shrink what "
    "overlaps") {
  for (const SolidWeighting weighting :
       {SolidWeighting::fraction, SolidWeighting::noble_torczynski, SolidWeighting::viscosity_independent})
    for (const double tau : {0.505, 0.8, 2.}) {
      const PartialSolidSettings settings{SolidOperator::force, weighting, 2., false};
      CHECK(solid_weight(settings, {0, 0, Vec3::Zero()}, tau) == 0);
      const double k_t = 2 * (tau - 0.5), whole = weighting == SolidWeighting::viscosity_independent
                                                      ? k_t / (kLeastOpenShare + k_t)
                                                      : 1;
      CHECK(solid_weight(settings, {1, 1, Vec3::Zero()}, tau) == Approx(whole).epsilon(1e-14));
      CHECK(solid_weight(settings, {1.4, 1.4, Vec3::Zero()}, tau) == Approx(whole).epsilon(1e-14));
      double last = 0;
      for (int tenths = 1; tenths < 10; ++tenths) {
        const double fraction = tenths / 10.;
        const double weight = solid_weight(settings, {fraction, fraction, Vec3::Zero()}, tau);
        CHECK(weight > last);
        CHECK(weight < 1);
        last = weight;
      }
    }
}

TEST_CASE("coefficients of partly covered cells that cannot work are refused") {
  CHECK_THROWS_WITH(check({SolidOperator::force, SolidWeighting::viscosity_independent, 0, false}),
                    Catch::Contains("coefficient"));
  CHECK_THROWS_WITH(check({SolidOperator::sc1, SolidWeighting::noble_torczynski, 1, true}),
                    Catch::Contains("viscosity_independent"));
}

namespace {

/// Keeps what it is shown, and counts how often each row is visited.
class Onlooker final : public RowVisitor {
 public:
  explicit Onlooker(const PartialSolidArrays& arrays) : arrays_(arrays), visits_(kTall[1] * kTall[2], 0) {}

  void before(const RowBlock& block) override {
    for (int y = block.begin_y; y < block.end_y; ++y)
      ++visits_[static_cast<std::size_t>(y + kTall[1] * block.z)];
  }
  void after(const RowBlock& block, const ExchangeArrays& exchange) override {
    for (int y = block.begin_y; y < block.end_y; ++y)
      for (int x = 0; x < kTall[0]; ++x) {
        const std::ptrdiff_t at = x + arrays_.row_pitch * y + arrays_.plane_pitch * block.z;
        if (!(arrays_.fraction[at] > 0)) continue;
        std::visit(
            [&](const auto& h) {
              const double hx = h[0][at], hy = h[1][at], hz = h[2][at];
              sum += hx * (1 + x) + hy * (1 + y) + hz;
            },
            exchange);
      }
  }
  bool reads_exchange() const override { return reads; }
  bool visited_all(int times) const {
    return std::all_of(visits_.begin(), visits_.end(), [&](int n) { return n == times; });
  }

  static constexpr Index3 kTall{300, 40, 5};  // several blocks a plane
  bool reads = true;
  double sum = 0;

 private:
  PartialSolidArrays arrays_;
  std::vector<int> visits_;
};

}  // namespace

TEST_CASE("a step with a visitor is the same bit for bit, and shows every row once with its exchange") {
  const Precision precision = GENERATE(Precision::double_precision, Precision::float_precision);
  const bool walls = GENERATE(false, true);
  FluidSettings settings;
  settings.precision = precision;
  settings.collision.relaxation_time = 0.7;
  if (walls) settings.faces[0].kind = settings.faces[1].kind = FaceKind::no_slip;
  const Decomposition whole = Decomposition::balanced(MPI_COMM_SELF, Onlooker::kTall);
  Fluid seen(settings, whole), alone(settings, whole);
  PartialSolidArrays arrays[2];
  Fluid* fluids[2] = {&seen, &alone};
  for (int f = 0; f < 2; ++f) {
    arrays[f] = fluids[f]->use_partial_solids({});
    for_each_cell(whole.local_box(), [&](int x, int y, int z) {
      const std::ptrdiff_t at = x + arrays[f].row_pitch * y + arrays[f].plane_pitch * z;
      const PartialSolidCell solids = random_solids({x, y, z}, 1);
      arrays[f].fraction[at] = static_cast<float>(solids.fraction);
      for (std::size_t a = 0; a < 3; ++a)
        arrays[f].momentum[a][at] = static_cast<float>(solids.momentum[static_cast<int>(a)]);
      for (int i = 0; i < kDirections; ++i)
        fluids[f]->set_population(i, {x, y, z}, random_population(i, {x, y, z}));
    });
  }
  Onlooker onlooker(arrays[0]);
  for (int step = 1; step <= 4; ++step) {
    onlooker.sum = 0;
    seen.step(onlooker);
    alone.step();
    CHECK(onlooker.visited_all(step));
    Onlooker afterwards(arrays[1]);  // the same sum in the same order, from the whole arrays
    for (int z = 0; z < Onlooker::kTall[2]; ++z)
      for (int y = 0; y < Onlooker::kTall[1]; y += alone.rows_per_block())
        afterwards.after({z, y, std::min(y + alone.rows_per_block(), Onlooker::kTall[1])},
                         arrays[1].exchange);
    CHECK(onlooker.sum == afterwards.sum);
  }
  long different = 0;
  for_each_cell(whole.local_box(), [&](int x, int y, int z) {
    for (int i = 0; i < kDirections; ++i)
      different += seen.population(i, {x, y, z}) != alone.population(i, {x, y, z}) ? 1 : 0;
  });
  CHECK(different == 0);
  CHECK(seen.rows_per_block() < Onlooker::kTall[1]);
}
