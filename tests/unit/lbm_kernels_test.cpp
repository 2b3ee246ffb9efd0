// The fast in-place kernels against the plain reference, on random states: every operator, option, storage
// type, instruction set and kind of face, edges and corners included.
#include <catch2/catch.hpp>

#include "lbm_test_tools.h"
#include "suffuse/lbm/reference_fluid.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

// Rows of 11 cells leave a remainder for every register width; six steps go through both kinds of step and
// let corners act on the inside.
constexpr Index3 kCells{11, 5, 6};
constexpr int kSteps = 6;

/// Rounding of a population: whole ones are at most 1/3, so 19 of them carry a few 1e-17 in the reference;
/// deviations in float are about 0.01 with 6e-8 relative each. A few hundred operations over six steps stay
/// below these.
double tolerance(Precision precision) {
  return precision == Precision::double_precision ? 2e-15 : 3e-7;
}

double largest_difference(const FluidSettings& settings, const Vec3& force, bool solids,
                          const Index3& cells = kCells) {
  const Decomposition whole = Decomposition::balanced(MPI_COMM_SELF, cells);
  Fluid fast(settings, whole);
  ReferenceFluid plain(settings, cells);
  const auto labels = [](const Index3& c) {
    return static_cast<std::uint8_t>(noise(c, 0, 7) > 0.6 ? 1 + (c[0] > 5 ? 1 : 0) : 0);
  };
  if (solids) {
    fast.set_solids(labels);
    plain.set_solids(labels);
  }
  fast.set_force(force);
  plain.set_force(force);
  for_each_cell(whole.local_box(), [&](int x, int y, int z) {
    if (solids && labels({x, y, z}) != 0) return;
    for (int i = 0; i < kDirections; ++i) {
      fast.set_population(i, {x, y, z}, random_population(i, {x, y, z}));
      plain.set_population(i, {x, y, z}, random_population(i, {x, y, z}));
    }
  });
  double worst = 0;
  for (int step = 0; step < kSteps; ++step) {
    fast.step();
    plain.step();
    for_each_cell(whole.local_box(), [&](int x, int y, int z) {
      if (fast.is_solid({x, y, z})) return;
      for (int i = 0; i < kDirections; ++i) {
        const double difference = std::abs(fast.population(i, {x, y, z}) - plain.population(i, {x, y, z}));
        worst = std::isfinite(difference) ? std::max(worst, difference) : 1e300;
      }
    });
    if (solids)
      for (const std::uint8_t label : {std::uint8_t{1}, std::uint8_t{2}}) {
        const double difference = (fast.solid_force(label) - plain.solid_force(label)).norm();
        worst = std::max(worst, difference / 100);  // a sum over some hundred links
      }
  }
  return worst;
}

std::string describe(const FluidSettings& s, bool forced, bool solids) {
  return name_of(s.collision.collision_operator) + (s.collision.smagorinsky > 0 ? " eddy" : "") +
         (s.collision.incompressible ? " incompressible" : "") + (forced ? " forced" : "") +
         (solids ? " solids " : " ") + name_of(s.instruction_set.value()) +
         (s.precision == Precision::float_precision ? " float" : " double");
}

FaceConditions channel() {
  FaceConditions faces = by_axis(FaceKind::periodic, FaceKind::no_slip, FaceKind::free_slip);
  return faces;
}

}  // namespace

TEST_CASE("fast kernels equal the reference for every operator, option, storage and instruction set") {
  int compared = 0;
  for (const InstructionSet set : available_instruction_sets())
    for (const Precision precision : {Precision::double_precision, Precision::float_precision})
      for (const CollisionFacts& facts : kCollisionOperators)
        for (int options = 0; options < 16; ++options) {
          FluidSettings settings;
          settings.instruction_set = set;
          settings.precision = precision;
          settings.faces = channel();
          settings.collision.collision_operator = facts.collision_operator;
          settings.collision.relaxation_time = 0.7;
          settings.collision.smagorinsky = (options & 1) != 0 ? 0.17 : 0;
          settings.collision.incompressible = (options & 2) != 0;
          const bool forced = (options & 4) != 0, solids = (options & 8) != 0;
          const Vec3 force = forced ? Vec3(1e-3, -2e-3, 5e-4) : Vec3::Zero();
          INFO(describe(settings, forced, solids));
          CHECK(largest_difference(settings, force, solids) < tolerance(precision));
          ++compared;
        }
  CHECK(compared >= 128);  // portable alone: 2 storage types x 4 operators x 16 options
}

TEST_CASE("fast kernels equal the reference for every meaningful mix of faces") {
  constexpr FaceKind kinds[] = {FaceKind::no_slip, FaceKind::free_slip, FaceKind::velocity,
                                FaceKind::pressure};
  const auto condition = [](FaceKind kind, int axis, bool high) {
    FaceCondition c{kind, Vec3::Zero(), 1};
    if (kind == FaceKind::velocity) {
      c.velocity = Vec3(0.01, -0.02, 0.015);
      c.velocity[axis] = high ? 0.004 : 0.005;
    }
    if (kind == FaceKind::pressure) c.density = 1.01;
    return c;
  };
  int compared = 0;
  // Every kind against every kind along each axis (5 pairs with periodic), thinned over the third axis.
  for (int code = 0; code < 17 * 17 * 17; code += 7) {
    FluidSettings settings;
    settings.collision.relaxation_time = 0.8;
    settings.instruction_set = default_instruction_set();
    const int pairs[3] = {code % 17, code / 17 % 17, code / 289};
    for (int axis = 0; axis < 3; ++axis) {
      if (pairs[axis] == 16) continue;
      settings.faces[static_cast<std::size_t>(2 * axis)] = condition(kinds[pairs[axis] / 4], axis, false);
      settings.faces[static_cast<std::size_t>(2 * axis + 1)] = condition(kinds[pairs[axis] % 4], axis, true);
    }
    try {
      check(settings.faces, kCells);
    } catch (const std::exception&) {
      continue;  // a leaking box: refused, see the tests of boundaries
    }
    INFO("code " << code);
    CHECK(largest_difference(settings, Vec3(1e-4, 2e-4, -1e-4), code % 3 == 0) <
          tolerance(settings.precision));
    ++compared;
  }
  CHECK(compared > 300);
}

TEST_CASE("faces agree with the reference for the incompressible equilibrium and for float") {
  FluidSettings settings;
  settings.instruction_set = default_instruction_set();
  settings.faces = by_axis(FaceKind::no_slip, FaceKind::velocity, FaceKind::pressure);
  settings.faces[2].velocity = Vec3(0.02, 0.003, 0);
  settings.faces[3].velocity = Vec3(0, 0, 0.02);
  settings.faces[4].density = 1.02;
  settings.faces[5].density = 0.99;
  for (const bool incompressible : {false, true})
    for (const Precision precision : {Precision::double_precision, Precision::float_precision}) {
      settings.collision.incompressible = incompressible;
      settings.precision = precision;
      CHECK(largest_difference(settings, Vec3::Zero(), true) < tolerance(precision));
    }
}

TEST_CASE(
    "faces across x that follow the kernel in groups of rows agree with the reference, one-cell boxes too") {
  // A group is some 300 kB of rows, 123 of these (FluidCore::sweep): boxes of 150 rows have two, and a copy
  // left out at their border would show.
  const auto kinds = {FaceKind::periodic, FaceKind::free_slip, FaceKind::no_slip};
  for (const FaceKind x : kinds)
    for (const FaceKind y : kinds)
      for (const Index3& cells : {Index3{11, 150, 3}, Index3{9, 1, 3}, Index3{1, 5, 1}}) {
        FluidSettings settings;
        settings.instruction_set = default_instruction_set();
        settings.faces = by_axis(x, y, FaceKind::periodic);
        INFO(name_of(x) << " " << name_of(y) << " rows " << cells[1]);
        CHECK(largest_difference(settings, Vec3(1e-4, 2e-4, -1e-4), false, cells) <
              tolerance(settings.precision));
        if (x == FaceKind::free_slip) {  // the two ends of x need not be of one kind
          settings.faces[1].kind = FaceKind::no_slip;
          settings.faces[4] = settings.faces[5] = {FaceKind::pressure, Vec3::Zero(), 1.01};
          CHECK(largest_difference(settings, Vec3::Zero(), false, cells) < tolerance(settings.precision));
        }
      }
}
