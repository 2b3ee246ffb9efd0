// Lid-driven cavity against the tables of Ghia, Ghia & Shin (1982).
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lbm_test_tools.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

struct TableRow {
  int re = 0;
  bool vertical_line = false;  ///< u along y at the middle of x; else v along x at the middle of y
  double position = 0, velocity = 0;
};

std::vector<TableRow> read_table() {
  std::ifstream file(SUFFUSE_TEST_DATA "/lbm_cavity_ghia_1982.csv");
  std::vector<TableRow> rows;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line[0] == 'r') continue;
    std::stringstream words(line);
    std::string re, which, position, velocity;
    std::getline(words, re, ',');
    std::getline(words, which, ',');
    std::getline(words, position, ',');
    std::getline(words, velocity, ',');
    rows.push_back({std::stoi(re), which == "u_of_y", std::stod(position), std::stod(velocity)});
  }
  return rows;
}

/// Cavity in the x-z plane, one cell deep (periodic), the lid at zhi moving along x.
Fluid steady_cavity(int cells, double lid, double re) {
  FluidSettings settings;
  settings.collision.relaxation_time = 3 * (lid * cells / re) + 0.5;  // of the viscosity U L/Re
  settings.faces = by_axis(FaceKind::no_slip, FaceKind::periodic, FaceKind::no_slip);
  settings.faces[5] = {FaceKind::velocity, Vec3(lid, 0, 0), 1};
  Fluid fluid(settings, Decomposition::balanced(MPI_COMM_SELF, {cells, 1, cells}));
  const auto energy = [&] {
    double sum = 0;
    for_each_cell(fluid.decomposition().local_box(), [&](int x, int y, int z) {
      sum += fluid.at({x, y, z}).velocity.squaredNorm();
    });
    return sum;
  };
  double before = 0, now = 1;
  while (std::abs(now / before - 1) > 1e-5) {  // per lid passage
    fluid.run(2 * std::lround(cells / lid / 2));
    before = now;
    now = energy();
  }
  return fluid;
}

/// Velocity on a centre line by linear interpolation between cell centres, and walls at the ends.
double on_line(const Fluid& fluid, int cells, double lid, bool vertical_line, double position) {
  const auto at = [&](int n) {
    const int a = cells / 2 - 1, b = cells / 2;
    if (n < 0) return 0.;
    if (n >= cells) return vertical_line ? lid : 0.;
    return vertical_line ? 0.5 * (fluid.at({a, 0, n}).velocity[0] + fluid.at({b, 0, n}).velocity[0])
                         : 0.5 * (fluid.at({n, 0, a}).velocity[2] + fluid.at({n, 0, b}).velocity[2]);
  };
  const double x = position * cells - 0.5;
  const int n = static_cast<int>(std::floor(x));
  // The first and last intervals are half a cell long: from the wall to a centre.
  if (n < 0) return (x + 0.5) / 0.5 * at(0);
  if (n + 1 >= cells) return at(cells - 1) + (x - n) / 0.5 * (at(cells) - at(cells - 1));
  return at(n) + (x - n) * (at(n + 1) - at(n));
}

void compare_with_table(int re, int cells, double lid, double margin) {
  const Fluid fluid = steady_cavity(cells, lid, re);
  int rows = 0;
  for (const TableRow& row : read_table()) {
    if (row.re != re) continue;
    INFO((row.vertical_line ? "u at y = " : "v at x = ") << row.position);
    CHECK(on_line(fluid, cells, lid, row.vertical_line, row.position) / lid ==
          Approx(row.velocity).margin(margin));
    ++rows;
  }
  REQUIRE(rows >= 20);
}

}  // namespace

// Ghia's tables are off by up to 0.009 of the lid velocity against later solutions of spectral accuracy (v =
// -0.2453 at its minimum for Re 100, now known as -0.2538). The grids here add a second-order error and
// linear interpolation of 0.001 to 0.003. The lid moves a twentieth of a cell a step: compressibility adds
// Mach^2 = 0.0075 of a few tenths.
TEST_CASE("the cavity at Re 100 follows Ghia et al. within 0.01 of the lid velocity") {
  compare_with_table(100, 64, 0.05, 0.01);
}

TEST_CASE("the cavity at Re 400 follows Ghia et al. within 0.01 of the lid velocity") {
  compare_with_table(400, 96, 0.05, 0.01);
}

TEST_CASE("the cavity's extreme velocities at Re 100 are those of solutions extrapolated from fine grids") {
  // Marchi, Suero & Araki (2009): u_min -0.21404, v_min -0.25380, v_max 0.17957 on the centre lines. 1 %: the
  // grid's second-order error at 64 cells plus compressibility.
  constexpr int cells = 64;
  constexpr double lid = 0.05;
  const Fluid fluid = steady_cavity(cells, lid, 100);
  double u_min = 0, v_min = 0, v_max = 0;
  for (int n = 1; n < 10 * cells; ++n) {
    const double position = n / (10. * cells);
    const double v = on_line(fluid, cells, lid, false, position) / lid;
    u_min = std::min(u_min, on_line(fluid, cells, lid, true, position) / lid);
    v_min = std::min(v_min, v);
    v_max = std::max(v_max, v);
  }
  CHECK(u_min == Approx(-0.21404).epsilon(0.01));
  CHECK(v_min == Approx(-0.25380).epsilon(0.01));
  CHECK(v_max == Approx(0.17957).epsilon(0.01));
}
