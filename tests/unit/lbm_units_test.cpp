// SI to lattice units and back.
#include <catch2/catch.hpp>
#include <cmath>

#include "suffuse/lbm/units.h"

using namespace suffuse;
using namespace suffuse::lbm;

namespace {

UnitsRequest water() {
  return {};
}

}  // namespace

TEST_CASE(
    "the thesis's fluidisation column: tau 0.53 at 40 micrometres gives its time step and inlet density") {
  UnitsRequest request = water();
  request.spacing = 4e-5;
  request.relaxation_time = 0.53;
  request.pressure_difference = 95.0;
  const Units units(request);
  CHECK(units.time_step() == Approx(1.6e-5).epsilon(1e-12));  // Appendix C
  // Appendix C: dP = cs^2 (rho_in - rho_out) rho_f (dx/dt)^2
  const double density = units.pressure_to_density_lattice(95.0);
  CHECK((density - 1) / 3 * 1000 * std::pow(4e-5 / 1.6e-5, 2) == Approx(95.0));
  CHECK(units.density_lattice_to_pressure(density) == Approx(95.0));
  CHECK(units.density_difference() == Approx(density - 1));
}

TEST_CASE("any two of spacing, relaxation time, time step and Mach number give the same units") {
  UnitsRequest base = water();
  base.spacing = 1e-4;
  base.time_step = 1e-3;
  base.largest_velocity = 0.005;
  const Units expected(base);
  CHECK(expected.relaxation_time() == Approx(0.5 + 3 * 1e-6 * 1e-3 / 1e-8));
  CHECK(expected.mach() == Approx(0.005 * 1e-3 / 1e-4 * std::sqrt(3.)));
  for (int first = 0; first < 4; ++first)
    for (int second = first + 1; second < 4; ++second) {
      UnitsRequest request = water();
      request.largest_velocity = 0.005;
      for (const int which : {first, second}) {
        if (which == 0) request.spacing = expected.spacing();
        if (which == 1) request.relaxation_time = expected.relaxation_time();
        if (which == 2) request.time_step = expected.time_step();
        if (which == 3) request.mach = expected.mach();
      }
      const Units units(request);
      CHECK(units.spacing() == Approx(1e-4));
      CHECK(units.time_step() == Approx(1e-3));
      CHECK(units.relaxation_time() == Approx(expected.relaxation_time()));
    }
}

TEST_CASE("conversions there and back are the identity and keep dimensions") {
  UnitsRequest request = water();
  request.spacing = 2e-4;
  request.time_step = 5e-4;
  const Units units(request);
  CHECK(units.velocity_to_si(units.velocity_to_lattice(0.3)) == Approx(0.3));
  CHECK(units.time_to_si(units.time_to_lattice(0.7)) == Approx(0.7));
  CHECK(units.steps_in(7.4 * units.time_step()) == 7);
  CHECK(units.steps_in(1e-300) == 1);
  CHECK(units.steps_in(1e300) == 1'000'000'000'000'000);
  // Gravity on a cell, back as a force: rho g dx^3.
  const Vec3 weight = units.force_to_si(units.acceleration_to_lattice(Vec3(0, 0, -9.81)));
  CHECK(weight[2] == Approx(-1000 * 9.81 * 8e-12));
  CHECK(units.force_density_to_lattice(Vec3(0, 0, 9810))[2] ==
        Approx(units.acceleration_to_lattice(Vec3(0, 0, 9.81))[2]));
}

TEST_CASE("values that cannot work are refused with the remedy") {
  UnitsRequest request = water();
  request.spacing = 1e-4;
  request.relaxation_time = 0.49;
  CHECK_THROWS_WITH(Units(request),
                    "fluid units: relaxation_time = 0.49, must be > 0.5; raise viscosity or timestep");
  request.relaxation_time = 0.6;
  request.time_step = 1e-4;
  CHECK_THROWS_WITH(Units(request), Catch::Contains("= 3, must be two"));
  request.time_step.reset();
  request.spacing = -1e-4;
  CHECK_THROWS_WITH(Units(request), Catch::Contains("spacing = -0.0001 m, must be > 0"));
  request.spacing = 1e-4;
  request.largest_velocity = 1.0;
  CHECK_THROWS_WITH(Units(request), Catch::Contains("mach = ") && Catch::Contains("lower timestep to"));
  request.largest_velocity.reset();
  request.pressure_difference = 1e6;
  CHECK_THROWS_WITH(Units(request),
                    Catch::Contains("density difference") && Catch::Contains("lower timestep to"));
  request.pressure_difference.reset();
  request.relaxation_time.reset();
  request.mach = 0.1;
  CHECK_THROWS_WITH(Units(request), Catch::Contains("add max_velocity"));
  request.mach.reset();
  request.time_step = 1e-9;
  request.viscosity = 1e-8;
  CHECK_THROWS_WITH(Units(request), Catch::Contains("above 0.50001"));
}

TEST_CASE("values that cost accuracy are told with the remedy, and the remedy works") {
  UnitsRequest request = water();
  request.spacing = 1e-3;
  request.time_step = 2e-3;
  request.largest_velocity = 0.1;
  const Units units(request);
  REQUIRE(units.warnings().size() == 2);
  CHECK_THAT(units.warnings()[0], Catch::Contains("Mach 0.35") && Catch::Contains("0.00058 s"));
  CHECK_THAT(units.warnings()[1], Catch::Contains("grid Reynolds number 100"));
  CHECK_THAT(units.summary(), Catch::Contains("relaxation time 0.506"));
  request.time_step = 0.00057;
  request.spacing = 9e-5;
  request.largest_velocity = 0.009;
  CHECK(Units(request).warnings().empty());
}
