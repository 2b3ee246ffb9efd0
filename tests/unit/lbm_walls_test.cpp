// Walls inside the box: flows that are known, spaces that keep their water, the same numbers on any ranks.
#include <mpi.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "lbm_test_tools.h"
#include "suffuse/lbm/fluid.h"
#include "suffuse/lbm/lattice.h"
#include "suffuse/lbm/wall_shapes.h"
#include "suffuse/lbm/wall_spaces.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

constexpr double kRelaxationTime = 0.8, kViscosity = (kRelaxationTime - 0.5) / 3;

FluidSettings settings_with(const FaceConditions& faces, Precision precision = Precision::double_precision) {
  FluidSettings settings;
  settings.faces = faces;
  settings.collision.relaxation_time = kRelaxationTime;
  settings.precision = precision;
  return settings;
}

Walls walls_of(const Decomposition& parts, const FaceConditions& faces, const std::vector<WallShape>& shapes,
               const std::vector<Index3>& wet = {}) {
  return divide(parts, faces, cut_links(parts, faces, shapes).links, wet);
}

/// Twelve triangles.
MeshWall box_mesh(const Vec3& low, const Vec3& high) {
  MeshWall mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      Vec3 corner[4];
      for (int n = 0; n < 4; ++n) {
        corner[n][axis] = upper ? high[axis] : low[axis];
        corner[n][b] = n == 1 || n == 2 ? high[b] : low[b];
        corner[n][c] = n >= 2 ? high[c] : low[c];
      }
      mesh.triangles.push_back({corner[0], corner[1], corner[2]});
      mesh.triangles.push_back({corner[0], corner[2], corner[3]});
    }
  return mesh;
}

/// A tube along an axis from facets whose corners lie so that the mean cross-section is that of the circle.
MeshWall tube_mesh(int axis, double radius, const Vec3& centre, double low, double high, int facets) {
  MeshWall mesh;
  const double turn = 2 * std::numbers::pi / facets, outer = radius * std::sqrt(turn / std::sin(turn));
  const auto corner = [&](int n, double height) {
    Vec3 point;
    point[axis] = height;
    point[(axis + 1) % 3] = centre[(axis + 1) % 3] + outer * std::cos(n * turn);
    point[(axis + 2) % 3] = centre[(axis + 2) % 3] + outer * std::sin(n * turn);
    return point;
  };
  for (int n = 0; n < facets; ++n) {
    const int next = (n + 1) % facets;
    mesh.triangles.push_back({corner(n, low), corner(next, low), corner(next, high)});
    mesh.triangles.push_back({corner(n, low), corner(next, high), corner(n, high)});
  }
  return mesh;
}

/// Steps until the flow has settled in a gap or tube of this half width.
long settled(double half_width) {
  return std::lround(3 * half_width * half_width / kViscosity);
}

struct PoiseuilleErrors {
  double flow, profile;
};
/// Flow between planes at z = low and low + width, driven along x, against g/(2 nu) s (width - s).
PoiseuilleErrors plane_poiseuille(double low, double width) {
  const Index3 cells{4, 4, static_cast<int>(std::ceil(low + width)) + 3};
  const FaceConditions faces = same_everywhere(FaceKind::periodic);
  const Decomposition parts = Decomposition::balanced(MPI_COMM_SELF, cells);
  Fluid fluid(settings_with(faces), parts);
  fluid.set_walls(walls_of(parts, faces, {PlaneWall{2, low}, PlaneWall{2, low + width}}));
  const double g = 8e-2 * kViscosity / (width * width);
  fluid.set_force({g, 0, 0});
  fluid.run(settled(width));
  double flow = 0, largest = 0;
  for (int z = 0; z < cells[2]; ++z) {
    const double s = z + 0.5 - low;
    if (s < 0 || s > width) continue;
    const double exact = g / (2 * kViscosity) * s * (width - s), u = fluid.at({1, 1, z}).velocity[0];
    flow += u;
    largest = std::max(largest, std::abs(u - exact));
  }
  const double top = g * width * width / (8 * kViscosity);
  return {flow / (g * width * width * width / (12 * kViscosity)) - 1, largest / top};
}

/// Discharge of a tube over pi R^4 g/(8 nu).
double tube_flow(const WallShape& shape, int axis, double radius, const Vec3& centre, const Index3& cells) {
  const FaceConditions faces = same_everywhere(FaceKind::periodic);
  const Decomposition parts = Decomposition::balanced(MPI_COMM_SELF, cells);
  Fluid fluid(settings_with(faces), parts);
  fluid.set_walls(walls_of(parts, faces, {shape}));
  Vec3 force = Vec3::Zero();
  force[axis] = 0.08 * kViscosity / (radius * radius);
  fluid.set_force(force);
  fluid.run(settled(radius));
  double flow = 0;
  for_each_cell({{0, 0, 0}, cells}, [&](int x, int y, int z) {
    Vec3 from = Vec3(x + 0.5, y + 0.5, z + 0.5) - centre;
    from[axis] = 0;
    if (from.norm() < radius) flow += fluid.at({x, y, z}).velocity[axis];
  });
  flow /= cells[static_cast<std::size_t>(axis)];
  return flow / (std::numbers::pi * std::pow(radius, 4) * force[axis] / (8 * kViscosity));
}

Index3 around_tube(int axis, double radius) {
  const int n = 2 * static_cast<int>(std::ceil(radius)) + 4;
  Index3 cells{n, n, n};
  cells[static_cast<std::size_t>(axis)] = 4;
  return cells;
}

}  // namespace

TEST_CASE("a plane between centres of cells is where it is: Poiseuille's profile, second order") {
  // Half-way up the links nothing is interpolated: with Lambda = 3/16 the parabola is exact, its sum over
  // cells too large by 1/(2 width^2).
  const PoiseuilleErrors half_way = plane_poiseuille(2, 8);
  CHECK(half_way.profile < 1e-9);
  CHECK(half_way.flow == Approx(1. / (2 * 8 * 8)).epsilon(1e-6));
  // The worst of ten places between the centres falls with the square of the resolution.
  const auto worst = [](double width) {
    PoiseuilleErrors largest{0, 0};
    for (int n = 0; n < 10; ++n) {
      const PoiseuilleErrors errors = plane_poiseuille(2 + 0.1 * n, width);
      largest.flow = std::max(largest.flow, std::abs(errors.flow));
      largest.profile = std::max(largest.profile, errors.profile);
    }
    return largest;
  };
  const PoiseuilleErrors coarse = worst(7.3), fine = worst(14.6);
  INFO("flow " << coarse.flow << " " << fine.flow << ", profile " << coarse.profile << " " << fine.profile);
  CHECK(coarse.profile < 0.05);
  CHECK(coarse.flow < 0.06);
  CHECK(fine.profile < 0.3 * coarse.profile);
  CHECK(fine.flow < 0.3 * coarse.flow);
}

TEST_CASE("a cylinder carries Hagen and Poiseuille's discharge within a per cent at ten cells, converging") {
  for (int axis = 0; axis < 3; ++axis) {
    const auto flow = [&](double radius) {
      const Vec3 centre(radius + 2.13, radius + 2.31, radius + 1.77);
      return tube_flow(CylinderWall{axis, radius, centre}, axis, radius, centre, around_tube(axis, radius));
    };
    const double coarse = flow(5.2), fine = flow(10.4);
    INFO(axis << ": " << coarse << " " << fine);
    CHECK(coarse == Approx(1).margin(0.03));
    CHECK(fine == Approx(1).margin(0.01));
  }
}

TEST_CASE("a tube of triangles carries what the cylinder does, through periodic sides") {
  for (int axis = 0; axis < 3; ++axis) {
    const double radius = 6.3;
    const Vec3 centre(radius + 2.13, radius + 2.31, radius + 1.77);
    const Index3 cells = around_tube(axis, radius);
    const double cylinder = tube_flow(CylinderWall{axis, radius, centre}, axis, radius, centre, cells);
    const double mesh = tube_flow(tube_mesh(axis, radius, centre, 0, 4, 64), axis, radius, centre, cells);
    CHECK(mesh == Approx(cylinder).epsilon(2e-3));
  }
}

TEST_CASE("a closed box of triangles keeps its water, whatever flows outside, and lets none through") {
  const Index3 cells{18, 15, 14};
  const Vec3 low(4.2, 3.5, 3.9), high(12.4, 10.5, 11);
  const FaceConditions faces = by_axis(FaceKind::periodic, FaceKind::free_slip, FaceKind::no_slip);
  const auto inside = [&](int x, int y, int z) {
    const Vec3 p(x + 0.5, y + 0.5, z + 0.5);
    return (p.array() >= low.array()).all() && (p.array() < high.array()).all();
  };
  for (const Precision precision : {Precision::double_precision, Precision::float_precision}) {
    const Decomposition parts = Decomposition::balanced(MPI_COMM_SELF, cells);
    Fluid fluid(settings_with(faces, precision), parts);
    const Walls walls = walls_of(parts, faces, {box_mesh(low, high)});
    CHECK(walls.spaces == 2);
    CHECK(walls.closed.empty());
    fluid.set_walls(walls);
    const auto mass_inside = [&] {
      double mass = 0;
      for_each_cell({{0, 0, 0}, cells}, [&](int x, int y, int z) {
        if (inside(x, y, z)) mass += fluid.at({x, y, z}).density - 1;
      });
      return mass;
    };
    // The outside flows and is denser than the inside, which is at rest at density one and stays so.
    fluid.set_equilibrium([&](const Index3& c) {
      return inside(c[0], c[1], c[2]) ? FluidPoint{} : FluidPoint{1.02, Vec3(0.05, 0.01, 0)};
    });
    fluid.run(300);
    for_each_cell({{0, 0, 0}, cells}, [&](int x, int y, int z) {
      if (inside(x, y, z)) REQUIRE(fluid.at({x, y, z}).velocity.norm() == 0);
    });
    CHECK(mass_inside() == 0);
    // Water in motion inside.
    set_random_state(fluid, {{0, 0, 0}, cells});
    const double before = mass_inside(), all = fluid.mass_deviation();
    fluid.run(1000);
    const double round_off = precision == Precision::double_precision ? 1e-12 : 1e-4;
    CHECK(mass_inside() == Approx(before).margin(round_off));
    CHECK(fluid.mass_deviation() == Approx(all).margin(10 * round_off));
    // Interpolation alone does not.
    Walls uncounted = walls;
    for (WallLink& link : uncounted.links) link.space = -1;
    fluid.set_walls(uncounted);
    set_random_state(fluid, {{0, 0, 0}, cells});
    fluid.run(1000);
    CHECK(std::abs(mass_inside() - before) > 100 * round_off);
  }
}

TEST_CASE("walls in every way through the box leave two spaces apart, beside faces of all kinds") {
  // A slanted sheet, a plane and a cylinder that cross the faces: what one side holds stays there.
  for (const FaceKind kind : {FaceKind::periodic, FaceKind::free_slip, FaceKind::no_slip}) {
    const Index3 cells{13, 12, 11};
    const FaceConditions faces = by_axis(kind, kind, FaceKind::free_slip);
    std::vector<WallShape> shapes{CylinderWall{2, 4.1, Vec3(6.3, 5.9, 0)}};
    if (kind != FaceKind::periodic)
      shapes = {MeshWall{{{Vec3(-9, -9, 2.3), Vec3(40, -9, 7.7), Vec3(-9, 40, 8.3)}}}, PlaneWall{0, 5.5}};
    const Decomposition parts = Decomposition::balanced(MPI_COMM_SELF, cells);
    const Walls walls = walls_of(parts, faces, shapes);
    CHECK(walls.spaces == (kind == FaceKind::periodic ? 2 : 4));
    // One space holds a step of tracer-like disturbance; the others never hear of it.
    const Walls one =
        divide(parts, faces, cut_links(parts, faces, shapes).links,
               std::vector<Index3>{kind == FaceKind::periodic ? Index3{6, 5, 5} : Index3{1, 1, 0}});
    REQUIRE(!one.closed.empty());
    const auto other = [&](int x, int y, int z) {
      return one.closed[static_cast<std::size_t>(x + cells[0] * (y + cells[1] * z))] != 0;
    };
    Fluid fluid(settings_with(faces), parts);
    fluid.set_walls(walls);
    for_each_cell({{0, 0, 0}, cells}, [&](int x, int y, int z) {
      for (int i = 0; i < kDirections; ++i)
        fluid.set_population(i, {x, y, z}, other(x, y, z) ? 0 : random_population(i, {x, y, z}));
    });
    fluid.run(200);
    for_each_cell({{0, 0, 0}, cells}, [&](int x, int y, int z) {
      if (other(x, y, z)) REQUIRE(fluid.at({x, y, z}).velocity.norm() == 0);
    });
  }
}

TEST_CASE("walls on the faces change nothing, nor do those outside") {
  const Index3 cells{8, 7, 6};
  const FaceConditions faces = by_axis(FaceKind::periodic, FaceKind::free_slip, FaceKind::no_slip);
  const Decomposition parts = Decomposition::balanced(MPI_COMM_SELF, cells);
  const WallCuts cuts =
      cut_links(parts, faces,
                {PlaneWall{2, 0}, PlaneWall{2, 6 - 1e-3}, PlaneWall{1, 7}, PlaneWall{2, -3},
                 CylinderWall{2, 40, Vec3(4, 3, 0)}, box_mesh(Vec3(-1, 0, 0), Vec3(9, 7, 6))});
  CHECK(cuts.links.empty());
  CHECK(cuts.count == std::vector<std::int64_t>(6, 0));
  CHECK(divide(parts, faces, cuts.links, std::vector<Index3>{{1, 1, 1}}).empty());
}

TEST_CASE("walls give the same numbers on any number of ranks, in double and float") {
  const Index3 cells{17, 14, 13};
  for (const Precision precision : {Precision::double_precision, Precision::float_precision}) {
    FaceConditions faces = by_axis(FaceKind::periodic, FaceKind::free_slip, FaceKind::pressure);
    faces[4].density = 1.01;
    const std::vector<WallShape> shapes{CylinderWall{2, 5.3, Vec3(8.1, 6.9, 0)}, PlaneWall{0, 14.2},
                                        box_mesh(Vec3(6.1, 5.2, 4.3), Vec3(9.9, 8.8, 8.2))};
    const std::vector<Index3> wet{{8, 2, 6}, {15, 1, 1}};
    const auto run = [&](MPI_Comm communicator) {
      const Decomposition parts = Decomposition::balanced(communicator, cells);
      Fluid fluid(settings_with(faces, precision), parts);
      fluid.set_walls(walls_of(parts, faces, shapes, wet));
      set_random_state(fluid, parts.local_box());
      fluid.set_force({1e-5, 2e-5, 0});
      fluid.run(51);
      return fluid;
    };
    const Fluid alone = run(MPI_COMM_SELF), shared = run(MPI_COMM_WORLD);
    for_each_cell(shared.decomposition().local_box(), [&](int x, int y, int z) {
      REQUIRE(shared.is_closed({x, y, z}) == alone.is_closed({x, y, z}));
      for (int i = 0; i < kDirections; ++i)
        REQUIRE(shared.population(i, {x, y, z}) == alone.population(i, {x, y, z}));
    });
    CHECK(shared.mass_deviation() == Approx(alone.mass_deviation()).epsilon(1e-10));
  }
}
