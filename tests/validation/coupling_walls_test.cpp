// Torque on a rotating sphere, force on a sphere that approaches a wall, another sphere, or moves along a
// wall.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "coupled_scene.h"

using namespace suffuse;
using namespace suffuse::coupling;
using namespace suffuse::coupling::test;

namespace {

/// Creeping motion towards a plane over Stokes' drag, the centre `height` radii away (docs key: brenner1961):
/// a no-slip wall, or a plane of symmetry, which is what two equal spheres have between them.
double approach_factor(double height, bool symmetric) {
  const double alpha = std::acosh(height), s = std::sinh(alpha);
  double sum = 0;
  for (int n = 1; n < 400; ++n) {
    const double m = 2 * n + 1, half = 0.5 * m * alpha;
    if (half > 300) break;
    const double ratio = symmetric ? (4 * std::cosh(half) * std::cosh(half) + m * m * s * s) /
                                         (2 * std::sinh(2 * half) - m * std::sinh(2 * alpha))
                                   : (2 * std::sinh(2 * half) + m * std::sinh(2 * alpha)) /
                                         (4 * std::sinh(half) * std::sinh(half) - m * m * s * s);
    sum += n * (n + 1.) / ((2 * n - 1.) * (2 * n + 3.)) * (ratio - 1);
  }
  return 4. / 3 * s * sum;
}

/// Motion along a no-slip wall (Faxen; docs key: happelbrenner1983).
double sliding_factor(double height) {
  const double l = 1 / height;
  return 1 / (1 - 9. / 16 * l + std::pow(l, 3) / 8 - 45. / 256 * std::pow(l, 4) - std::pow(l, 5) / 16);
}

enum class Motion { towards_wall, towards_sphere, along_wall };

/// The sphere stays where it is while its cells are given a velocity: the quasi-steady force. The other walls
/// are four diameters off.
double drag_near_plane(double diameter, double gap, Motion motion) {
  CoupledSettings settings = lattice_settings(1, default_solids());
  for (auto& face : settings.fluid.faces) face.kind = lbm::FaceKind::no_slip;
  if (motion == Motion::towards_sphere) settings.fluid.faces[4].kind = lbm::FaceKind::free_slip;
  const int width = static_cast<int>(8 * diameter), height = static_cast<int>(6 * diameter);
  Scene scene(settings, {width, width, height},
              {sphere_at(Vec3(0.5 * width + 0.3, 0.5 * width + 0.2, 0.5 * diameter + gap), 0.5 * diameter)});
  const double speed = 1e-5;
  const int axis = motion == Motion::along_wall ? 0 : 2;
  scene.grains.list[0].velocity[axis] = axis == 2 ? -speed : speed;
  double last = 0, now = 0;
  for (int n = 0; n < 40; ++n) {
    scene.run(static_cast<long>(4 * diameter * diameter));
    now = std::abs(scene.force()[axis]);
    if (std::abs(now / last - 1) < 1e-3) break;
    last = now;
  }
  return now / (3 * std::numbers::pi * settings.units.viscosity * diameter * speed);
}

}  // namespace

TEST_CASE("the torque on a rotating sphere is 8 pi mu a^3 w over 1 - c in a periodic box") {
  // Rotlets of a cubic array turn each other by -T/(6 mu V), which is -c of a sphere's own turning.
  const double diameter = GENERATE(5., 10.), tau = GENERATE(0.6, 1.2);
  const int cells = static_cast<int>(3 * diameter);
  Scene scene(lattice_settings(tau, default_solids()), {cells, cells, cells},
              {sphere_at(Vec3(0.5 * cells + 0.3, 0.5 * cells + 0.1, 0.5 * cells + 0.4), 0.5 * diameter)});
  const double nu = lbm::viscosity_of(tau), spin = 1e-4, a = 0.5 * diameter;
  scene.grains.list[0].angular_velocity = spin * Vec3(0.6, 0, 0.8);
  scene.run(static_cast<long>(cells * cells / nu / 4));  // ten times the slowest mode's L^2/(4 pi^2 nu)
  const double solid = sphere_volume(a) / std::pow(cells, 3);
  const double expected = 8 * std::numbers::pi * nu * a * a * a * spin / (1 - solid);
  const double torque = -scene.torque().dot(Vec3(0.6, 0, 0.8));
  std::printf("torque, %g cells a diameter, tau %g: %+.1f %%\n", diameter, tau,
              100 * (torque / expected - 1));
  // Goes with a^3: one per cent in the hydrodynamic radius is three here. Measured +5.1 % at 5 cells, +1.2 %
  // at 10; +4.1 and +1.0 % while nearly full cells were too open by a hundredth: what they hold back counts
  // here, and the law's weight is on packings (a lone sphere's drag is 2.2 % high).
  CHECK(std::abs(torque / expected - 1) < (diameter < 8 ? 0.055 : 0.02));
  CHECK((scene.torque() + torque * Vec3(0.6, 0, 0.8)).norm() < 0.01 * expected);
}

TEST_CASE("a sphere feels a plane until about a cell from it", "[.long]") {
  const double diameter = GENERATE(5., 10.);
  std::printf(
      "%g cells a diameter: force over the series' (and over Stokes')\n   gap/cells   gap/a  to a wall       "
      "   to a sphere"
      "        along a wall\n",
      diameter);
  for (const double gap : {5., 2., 1., 0.5, 0.25, 0.1}) {
    const double a = 0.5 * diameter, height = 1 + gap / a;
    const double wall = drag_near_plane(diameter, gap, Motion::towards_wall),
                 pair = drag_near_plane(diameter, gap, Motion::towards_sphere),
                 along = drag_near_plane(diameter, gap, Motion::along_wall);
    const double wall_ratio = wall / approach_factor(height, false),
                 pair_ratio = pair / approach_factor(height, true),
                 along_ratio = along / sliding_factor(height);
    std::printf("   %8.2f  %6.3f  %.3f (%6.2f)    %.3f (%6.2f)    %.3f (%6.2f)\n", gap, gap / a, wall_ratio,
                wall, pair_ratio, pair, along_ratio, along);
    // The far walls add up to a tenth at the largest gap; below one cell the lattice loses the lubrication
    // film.
    if (gap >= 1) {
      CHECK(std::abs(wall_ratio - 1) < 0.15);
      CHECK(std::abs(along_ratio - 1) < 0.15);
      CHECK(std::abs(pair_ratio - 1) < 0.25);
    }
    CHECK(wall_ratio < 1.25);
  }
}
