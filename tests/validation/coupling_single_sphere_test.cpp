// Drag of one held sphere at Reynolds numbers of 0.01 to 1, as thesis section 3.4.1: boxes of 10 x 20 x 10
// and 20 x 20 x 20 diameters, five cells a diameter, relaxation time 0.59.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "coupled_scene.h"

using namespace suffuse;
using namespace suffuse::coupling;
using namespace suffuse::coupling::test;

namespace {

constexpr double kTau = 0.59, kDiameter = 5;
constexpr int kLength = 100;  // between the faces, cells: 20 diameters

/// Drag over Stokes' of an unbounded sphere: Oseen's first term up to Re = 0.01, the fit of Clift, Grace and
/// Weber (docs key: clift1978) above; other correlations differ from it by 1 to 2 % at Re = 1.
double inertia_factor(double reynolds) {
  if (reynolds <= 0.01) return 1 + 3. / 16 * reynolds;
  return 1 + 0.1315 * std::pow(reynolds, 0.82 - 0.05 * std::log10(reynolds));
}

/// The same in the middle of a long duct of width w with free-slip sides and a uniform inflow. The sphere's
/// mirror images form a plane square array of point forces in a stream; in Fourier space across it each wave
/// number k adds F/(mu w^2) / (4 sqrt(k^2 + s^2)), s = U/(2 nu), after Oseen's equation, or F/(mu 8 pi R)
/// exp(-s R) for an image at the distance R. The inflow fixes what k = 0 would add, 1/(4 s w^2). For s = 0
/// the sum is -3.90026/(8 pi w), 4 zeta(1/2) beta(1/2) = -3.90026.
double duct_factor(double reynolds, double width) {
  const double s = reynolds / (2 * kDiameter), factor = inertia_factor(reynolds);
  const int reach = static_cast<int>(40 / (s * width)) + 2;
  double images = -1 / (4 * s * width * width);
  for (int m = -reach; m <= reach; ++m)
    for (int n = -reach; n <= reach; ++n) {
      const double distance = width * std::hypot(m, n);
      if (distance > 0) images += std::exp(-s * distance) / (8 * std::numbers::pi * distance);
    }
  return factor / (1 + 6 * std::numbers::pi * (0.5 * kDiameter) * factor * images);
}

/// Creeping flow past a sphere at rest, along y.
Vec3 stokes_flow(const Vec3& from_centre, double radius, double speed) {
  const double r = from_centre.norm();
  if (r <= radius) return Vec3::Zero();
  const double q = radius / r, c = from_centre[1] / r;
  return speed *
         ((1 - 0.75 * q - 0.25 * q * q * q) * Vec3(0, 1, 0) - 0.75 * (q - q * q * q) * c * from_centre / r);
}

/// Force / (3 pi mu d U) in a uniform stream along y: velocity face low, pressure face high, free-slip sides.
double drag_in_stream(const CoupledSettings& base, double reynolds, int width) {
  CoupledSettings settings = base;
  const double nu = settings.units.viscosity, speed = reynolds * nu / kDiameter;
  auto& faces = settings.fluid.faces;
  for (auto& face : faces) face.kind = lbm::FaceKind::free_slip;
  faces[2].kind = lbm::FaceKind::velocity;
  faces[2].velocity = Vec3(0, speed, 0);
  faces[3].kind = lbm::FaceKind::pressure;
  const Vec3 centre(width / 2 + 0.3, kLength / 2 + 0.2, width / 2 + 0.1);  // off the middle of cells
  Scene scene(settings, {width, kLength, width}, {sphere_at(centre, 0.5 * kDiameter)});
  const auto start = [&](const Index3& c) {
    return stokes_flow(Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5) - centre, 0.5 * kDiameter, speed);
  };
  // Every plane across lets the inflow pass: the mirror images of the sphere take back what it holds up. A
  // start that lacks it leaves a sound wave between the faces that takes 1e5 steps to decay.
  std::vector<double> missing(kLength, speed);
  for (int y = 0; y < kLength; ++y)
    for (int z = 0; z < width; ++z)
      for (int x = 0; x < width; ++x)
        missing[static_cast<std::size_t>(y)] -= start({x, y, z})[1] / (width * width);
  scene.simulation->fluid().set_equilibrium([&](const Index3& c) {
    return lbm::FluidPoint{1, start(c) + Vec3(0, missing[static_cast<std::size_t>(c[1])], 0)};
  });
  // Means over 500 steps, until two that follow each other agree within 1e-3, but not at a turning point: the
  // wake takes a while: at Re = 1 the drag falls for 1000 to 1500 steps before it rises to its end. What
  // remains far from the sphere spreads in L^2/(pi^2 nu) = 8400 steps (10 diameters), but the start holds the
  // images' effect already.
  double last = 0, now = 0;
  const int least = reynolds < 0.5 ? 3 : width * width / 500;
  for (int n = 0; n < 12 + least; ++n) {
    last = now;
    now = 0;
    for (int k = 0; k < 10; ++k) {
      scene.run(50);
      now += scene.force()[1] / 10;
    }
    std::printf("    %d steps: %.4f\n", 500 * (n + 1), now / (3 * std::numbers::pi * nu * kDiameter * speed));
    if (n >= least && std::abs(now / last - 1) < 1e-3) break;
  }
  return now / (3 * std::numbers::pi * nu * kDiameter * speed);
}

void compare(const char* name, const CoupledSettings& settings, double reynolds, int width_in_diameters,
             double allowed) {
  const int width = width_in_diameters * static_cast<int>(kDiameter);
  const double drag = drag_in_stream(settings, reynolds, width), expected = duct_factor(reynolds, width);
  std::printf("%s Re %.2f, %d diameters wide: drag over Stokes' %.4f, expected %.4f: %+.1f %%\n", name,
              reynolds, width_in_diameters, drag, expected, 100 * (drag / expected - 1));
  CHECK(std::abs(drag / expected - 1) < allowed);
}

}  // namespace

// Bounds: the default's is the aim of 3 % (that of the arrays at ten cells). The thesis's operators lie
// lower, by as much as their effective radius is smaller: 4 % measured before the bound was set.
TEST_CASE("drag of a single sphere at five cells a diameter and a Reynolds number of 0.1") {
  // Creeping flow: what Oseen adds to the drag, 3 Re/16, the images take back, as it is the sphere's own
  // field at its place that the inflow fixes.
  CHECK(duct_factor(0.01, 50) == Approx(1 / (1 - 0.75 * 3.90026 / 20)).epsilon(1e-4));
  compare("default", lattice_settings(kTau, default_solids()), 0.1, 10, 0.03);
}

TEST_CASE("drag of a single sphere at other Reynolds numbers and with the thesis's preset", "[.long]") {
  compare("default", lattice_settings(kTau, default_solids()), 0.01, 10, 0.03);
  compare("default", lattice_settings(kTau, default_solids()), 1, 10, 0.03);
  for (const double reynolds : {0.01, 0.1, 1.}) compare("thesis ", thesis_settings(kTau), reynolds, 10, 0.06);
}

TEST_CASE("drag of a single sphere in a box twenty diameters wide", "[.long]") {
  for (const double reynolds : {1., 0.1})
    compare("default", lattice_settings(kTau, default_solids()), reynolds, 20, 0.03);
  compare("thesis ", thesis_settings(kTau), 0.1, 20, 0.06);
}

TEST_CASE("drag of a sphere in a periodic box matches Hasimoto's series at five and ten cells a diameter") {
  // x = a/L = 1/8: 1/K = 1 - 2.837297 x + 4.188790 x^3 - 27.36 x^6 (docs key: hasimoto1959), U the mean over
  // the box.
  const double diameter = GENERATE(5., 10.);
  const double tau = GENERATE(0.59, 1.2);
  if (diameter > 8 && tau < 1) return;  // the drag does not change with tau, and this is the slow one
  const int cells = static_cast<int>(4 * diameter);
  CoupledSettings settings = lattice_settings(tau, default_solids());
  const double nu = settings.units.viscosity, driven = 1e-6 * nu * nu;
  settings.pressure_gradient = Vec3(driven, 0, 0);
  const double offset = GENERATE(0., 0.37);
  Scene scene(
      settings, {cells, cells, cells},
      {sphere_at(Vec3(0.5 * cells + offset, 0.5 * cells + 0.7 * offset, 0.5 * cells), 0.5 * diameter)});
  const double volume = std::pow(cells, 3), x = 0.125;
  const double expected = 1 / (1 - 2.837297 * x + 4.188790 * std::pow(x, 3) - 27.36 * std::pow(x, 6));
  // From near the mean flow to come: it takes L^3/(3 pi nu d K), eleven times what the flow's shape takes.
  const Vec3 guess(driven * volume / (3 * std::numbers::pi * nu * diameter * expected), 0, 0);
  scene.simulation->fluid().set_equilibrium([&](const Index3&) { return lbm::FluidPoint{1, guess}; });
  double last = 0, flux = 0;
  for (int n = 0; n < 100; ++n) {
    scene.run(static_cast<long>(cells * cells / nu / 40));  // L^2/(4 pi^2 nu)
    flux = scene.simulation->fluid().momentum()[0];
    // Eleven times the change is still to come; the force says when it only passes a turning point.
    if (std::abs(flux / last - 1) < 5e-5 && std::abs(scene.force()[0] / (driven * volume) - 1) < 5e-4) break;
    last = flux;
  }
  const double mean =
      flux / volume - 0.5 * scene.force()[0] / volume;  // momentum() knows nothing of the exchange
  const double drag = scene.force()[0] / (3 * std::numbers::pi * nu * diameter * mean);
  std::printf("Hasimoto, %g cells a diameter, tau %g, offset %g: drag %.4f, series %.4f: %+.2f %%\n",
              diameter, tau, offset, drag, expected, 100 * (drag / expected - 1));
  // The coefficient follows a fit with a scatter of some 2 % in the drag; what the position in the cell does
  // is below 1 %.
  CHECK(std::abs(drag / expected - 1) < 0.03);
  // All of the mean pressure gradient ends up on the sphere.
  CHECK(scene.force()[0] == Approx(driven * volume).epsilon(1e-3));
}
