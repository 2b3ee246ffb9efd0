// Flow between plates and through ducts, steady and oscillating.
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "lbm_test_tools.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

constexpr double kPi = std::numbers::pi;

Fluid make(const FluidSettings& settings, const Index3& cells) {
  return Fluid(settings, Decomposition::balanced(MPI_COMM_SELF, cells));
}

/// Largest difference from the parabola G x (H - x)/(2 nu), relative to its top, at steady state.
double poiseuille_error(const CollisionSettings& collision, int axis, int width) {
  FluidSettings settings;
  settings.collision = collision;
  settings.faces[static_cast<std::size_t>(2 * axis)].kind = FaceKind::no_slip;
  settings.faces[static_cast<std::size_t>(2 * axis + 1)].kind = FaceKind::no_slip;
  Index3 cells{1, 1, 1};
  cells[static_cast<std::size_t>(axis)] = width;
  const int flow = (axis + 1) % 3;
  const double viscosity = viscosity_of(collision.relaxation_time), top = 1e-3;
  Vec3 force = Vec3::Zero();
  force[flow] = 8 * viscosity * top / (width * width);
  Fluid fluid = make(settings, cells);
  fluid.set_force(force);
  // The slowest mode decays as exp(-pi^2 nu t / H^2): 1e-13 after 3 H^2/nu; large tau relaxes at its own
  // pace.
  fluid.run(static_cast<long>(3.2 * width * width / viscosity) + 4000);
  double worst = 0;
  for (int n = 0; n < width; ++n) {
    Index3 cell{0, 0, 0};
    cell[static_cast<std::size_t>(axis)] = n;
    const double x = n + 0.5;
    const double exact = force[flow] * x * (width - x) / (2 * viscosity);
    worst = std::max(worst, std::abs(fluid.at(cell).velocity[flow] - exact));
  }
  return worst / top;
}

/// Mean axial velocity and its share at the axis of a square duct driven by a body force, times nu/(G b^2).
double duct_mean(int width) {
  FluidSettings settings;
  settings.collision.relaxation_time = 1.2;
  settings.faces = by_axis(FaceKind::no_slip, FaceKind::no_slip, FaceKind::periodic);
  Fluid fluid = make(settings, {width, width, 1});
  const double viscosity = viscosity_of(1.2), g = 1e-4 / width / width;
  fluid.set_force(Vec3(0, 0, g));
  fluid.run(static_cast<long>(1.2 * width * width / viscosity));
  return fluid.momentum()[2] / (width * width) * viscosity / (g * width * width);
}

struct DuctFlow {
  double mass_flux = 0, inlet_velocity = 0, outlet_velocity = 0, pressure_bend = 0;
};

/// A square duct between two pressure faces, `drop` the density difference; velocities are means over a
/// section, divided by the series' value for the pressure gradient drop/(3 L).
DuctFlow pressure_duct(int width, int length, double drop, double relaxation_time, bool incompressible) {
  FluidSettings settings;
  settings.collision.relaxation_time = relaxation_time;
  settings.collision.incompressible = incompressible;
  settings.faces = by_axis(FaceKind::no_slip, FaceKind::no_slip, FaceKind::pressure);
  settings.faces[4].density = 1 + drop / 2;
  settings.faces[5].density = 1 - drop / 2;
  Fluid fluid = make(settings, {width, width, length});
  const double viscosity = viscosity_of(relaxation_time);
  // Twice the viscous time of the duct and many passages of sound.
  fluid.run(static_cast<long>(1.5 * width * width / viscosity) + 40L * length);
  const double series = 0.0351443 * (drop / 3 / length) * width * width / viscosity;
  const auto section = [&](int z, bool mass) {
    double sum = 0;
    for (int y = 0; y < width; ++y)
      for (int x = 0; x < width; ++x) {
        const FluidPoint p = fluid.at({x, y, z});
        sum += p.velocity[2] * (mass ? p.density : 1);
      }
    return sum / (width * width) / series;
  };
  DuctFlow flow;
  flow.mass_flux = section(length / 2, !incompressible);
  flow.inlet_velocity = section(0, false);
  flow.outlet_velocity = section(length - 1, false);
  for (int z = 0; z < length; ++z) {
    const double linear = 1 + drop * (0.5 - (z + 0.5) / length);
    flow.pressure_bend =
        std::max(flow.pressure_bend, std::abs(fluid.at({width / 2, width / 2, z}).density - linear) / drop);
  }
  return flow;
}

}  // namespace

TEST_CASE(
    "Poiseuille flow between plates is exact to 1e-10 with TRT at Lambda 3/16, whatever the viscosity") {
  for (const double tau : {0.55, 0.8, 1.0, 3.0}) {
    CollisionSettings collision;
    collision.relaxation_time = tau;
    CHECK(poiseuille_error(collision, 0, 12) < 1e-10);
  }
  CollisionSettings collision;
  CHECK(poiseuille_error(collision, 1, 12) < 1e-10);
  CHECK(poiseuille_error(collision, 2, 12) < 1e-10);
  collision.incompressible = true;
  CHECK(poiseuille_error(collision, 0, 12) < 1e-10);
}

TEST_CASE("BGK moves the wall with the viscosity, which is why TRT is the default") {
  // The slip of half-way bounce-back under BGK: u_s/u_max = (16 Lambda - 3)/(3 H^2) with Lambda = (tau -
  // 1/2)^2 (docs key: ginzburg2008), to rounding in this flow.
  for (const double tau : {0.8, 2.0}) {
    CollisionSettings collision;
    collision.collision_operator = CollisionOperator::bgk;
    collision.relaxation_time = tau;
    const double slip = std::abs(16 * (tau - 0.5) * (tau - 0.5) - 3) / (3 * 12. * 12);
    CHECK(poiseuille_error(collision, 0, 12) == Approx(slip).epsilon(1e-6));
  }
}

TEST_CASE("operators that relax third moments at rate one move the wall by that rate's Lambda") {
  // The same formula, with Lambda = (tau - 1/2)(1 - 1/2); these operators have terms of the
  // velocity's square besides, 1e-6 here.
  for (const CollisionFacts& facts : kCollisionOperators)
    for (const double tau : {0.8, 2.0}) {
      if (facts.odd_rate != OddRate::own) continue;
      INFO(facts.word << " tau " << tau);
      CollisionSettings collision;
      collision.collision_operator = facts.collision_operator;
      collision.relaxation_time = tau;
      const double slip = std::abs(8 * (tau - 0.5) - 3) / (3 * 12. * 12);
      CHECK(poiseuille_error(collision, 0, 12) == Approx(slip).epsilon(1e-5));
    }
}

TEST_CASE("the discharge of a square duct converges to its series at second order") {
  const double series = 0.0351443;  // Q mu/(G b^4), six digits
  const double e8 = std::abs(duct_mean(8) / series - 1), e16 = std::abs(duct_mean(16) / series - 1),
               e32 = std::abs(duct_mean(32) / series - 1);
  // 1.9: second order with the next term of the expansion still visible on 8 cells.
  CHECK(std::log2(e8 / e16) > 1.9);
  CHECK(std::log2(e16 / e32) > 1.9);
  CHECK(e32 < 0.002);
}

TEST_CASE("a duct between pressure faces passes the discharge of the series and its pressure is linear") {
  const DuctFlow flow = pressure_duct(24, 32, 1e-3, 1.0, false);
  CHECK(flow.mass_flux == Approx(1).epsilon(0.005));
  // 0.2 % of the drop: the face's first cells see the section's mean pressure only to second order.
  CHECK(flow.pressure_bend < 0.002);
}

TEST_CASE(
    "the incompressible equilibrium keeps the discharge along a duct when densities differ by six per cent") {
  // Re of about 3 at this drop, so the exact flow is still the series', fully developed from end to end.
  const DuctFlow compressible = pressure_duct(16, 32, 0.06, 1.5, false);
  const DuctFlow incompressible = pressure_duct(16, 32, 0.06, 1.5, true);
  // Compressible: what is conserved is the mass flux, so the velocity grows by the six per cent (31 of 32 of
  // the length lie between the first and the last cell's centre).
  CHECK(compressible.outlet_velocity / compressible.inlet_velocity ==
        Approx(1 + 0.06 * 31. / 32).margin(0.004));
  CHECK(incompressible.outlet_velocity == Approx(incompressible.inlet_velocity).epsilon(1e-6));
  // The grid's own error at 16 cells is 0.5 % (second order; see the duct above), which both share.
  CHECK(incompressible.mass_flux == Approx(1).epsilon(0.008));
  CHECK(incompressible.inlet_velocity == Approx(1).epsilon(0.008));
}

TEST_CASE("Couette flow under a moving face is linear to rounding and starts as the series says") {
  constexpr int width = 32;
  FluidSettings settings;
  settings.collision.relaxation_time = 1.0;
  settings.faces[4].kind = FaceKind::no_slip;
  settings.faces[5] = {FaceKind::velocity, Vec3(0.01, 0, 0), 1};
  Fluid fluid = make(settings, {4, 1, width});
  const double viscosity = viscosity_of(1.0);
  const auto middle = [&] {
    return 0.5 * (fluid.at({0, 0, width / 2 - 1}).velocity[0] + fluid.at({0, 0, width / 2}).velocity[0]) /
           0.01;
  };
  fluid.run(std::lround(0.1 * width * width / viscosity));
  CHECK(middle() == Approx(0.2627563).epsilon(0.005));  // nu t/H^2 = 0.1; second order: 1/H^2 = 0.1 %
  fluid.run(std::lround(0.15 * width * width / viscosity));
  CHECK(middle() == Approx(0.4460115).epsilon(0.005));
  fluid.run(static_cast<long>(3.5 * width * width / viscosity));
  for (int z = 0; z < width; ++z)
    CHECK(fluid.at({1, 0, z}).velocity[0] == Approx(0.01 * (z + 0.5) / width).epsilon(1e-10));
}

TEST_CASE("Womersley flow between plates has the amplitude and phase of the exact solution") {
  constexpr int width = 40;
  const double tau = 0.8, viscosity = viscosity_of(tau), alpha = 4;  // half-width sqrt(omega/nu)
  const double frequency = viscosity * alpha * alpha / (0.25 * width * width);
  const long period = std::lround(2 * kPi / frequency);
  const double omega = 2 * kPi / static_cast<double>(period), g = 1e-7;
  FluidSettings settings;
  settings.collision.relaxation_time = tau;
  settings.faces[0].kind = settings.faces[1].kind = FaceKind::no_slip;
  Fluid fluid = make(settings, {width, 1, 1});
  std::vector<std::complex<double>> amplitude(width);
  const long warm_up = 6 * period;  // transients decay as exp(-pi^2 nu t/H^2)
  for (long n = 0; n < warm_up + period; ++n) {
    fluid.set_force(Vec3(0, 0, g * std::cos(omega * static_cast<double>(n))));
    if (n >= warm_up)
      for (int x = 0; x < width; ++x)
        amplitude[static_cast<std::size_t>(x)] += 2. / static_cast<double>(period) *
                                                  fluid.at({x, 0, 0}).velocity[2] *
                                                  std::polar(1., -omega * static_cast<double>(n));
    fluid.step();
  }
  const std::complex<double> i(0, 1), k = std::sqrt(i * omega / viscosity);
  double worst = 0;
  for (int x = 0; x < width; ++x) {
    const double y = x + 0.5 - 0.5 * width;
    const std::complex<double> exact =
        g / (i * omega) * (1. - std::cosh(k * y) / std::cosh(k * (0.5 * width)));
    worst = std::max(worst, std::abs(amplitude[static_cast<std::size_t>(x)] - exact));
    if (x == width / 2) {
      CHECK(std::abs(amplitude[static_cast<std::size_t>(x)]) == Approx(std::abs(exact)).epsilon(0.002));
      CHECK(std::arg(amplitude[static_cast<std::size_t>(x)]) == Approx(std::arg(exact)).margin(0.002));
    }
  }
  // The Stokes layer is 7 cells thick: second order gives some parts in a thousand of the amplitude g/omega.
  CHECK(worst < 0.003 * g / omega);
}

TEST_CASE("float keeps velocities of a millionth: stored deviations carry their own digits") {
  FluidSettings settings;
  settings.precision = Precision::float_precision;
  settings.collision.relaxation_time = 0.8;
  settings.faces[0].kind = settings.faces[1].kind = FaceKind::no_slip;
  constexpr int width = 16;
  Fluid fluid = make(settings, {width, 4, 4});
  const double top = 1e-6, g = 8 * viscosity_of(0.8) * top / (width * width);
  fluid.set_force(Vec3(0, g, 0));
  fluid.run(10000);
  double worst = 0;
  for (int x = 0; x < width; ++x) {
    const double s = (x + 0.5) / width;
    worst = std::max(worst, std::abs(fluid.at({x, 1, 2}).velocity[1] - 4 * top * s * (1 - s)));
  }
  INFO("largest error relative to the top velocity: " << worst / top);
  // Rounding of the deviations (6e-8 each step) against a decay time of some hundred steps.
  CHECK(worst < 1e-4 * top);
}
