// Flow through a fixed porous cell: permeability does not depend on the viscosity, forces balance.
#include <catch2/catch.hpp>
#include <cmath>

#include "lbm_test_tools.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

constexpr int kSize = 12;

/// Four overlapping spheres at fixed places in a periodic cube; about two fifths of the cells are solid.
std::uint8_t grain(const Index3& c) {
  constexpr double centres[4][3] = {{2.3, 3.1, 2.7}, {8.4, 8.9, 3.2}, {8.8, 2.6, 8.1}, {2.9, 8.2, 9.0}};
  for (const auto& centre : centres) {
    double squared = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      double d = c[a] + 0.5 - centre[a];
      d -= kSize * std::round(d / kSize);
      squared += d * d;
    }
    if (squared < 3.4 * 3.4) return 1;
  }
  return 0;
}

struct Steady {
  double permeability = 0;   ///< nu U/g, cells^2
  double force_balance = 0;  ///< (force on the grains)/(force on the fluid) - 1
};

Steady flow_through(double tau, CollisionOperator op) {
  FluidSettings settings;
  settings.collision.collision_operator = op;
  settings.collision.relaxation_time = tau;
  Fluid fluid(settings, Decomposition::balanced(MPI_COMM_SELF, {kSize, kSize, kSize}));
  fluid.set_solids(grain);
  // Force scaled with nu^2: the same Reynolds number (1e-6) at every viscosity; so small that neither inertia
  // nor compressibility show.
  const double nu = viscosity_of(tau), g = 1e-8 * nu * nu;
  fluid.set_force(Vec3(g, 0, 0));
  double flux = 0, last = 1;
  // The slowest mode decays within a pore's width squared over nu, some 30/nu steps.
  while (std::abs(flux / last - 1) > 1e-10) {
    last = flux == 0 ? 1 : flux;
    fluid.run(2 * std::lround(100 + 15 / nu));
    flux = fluid.momentum()[0];
  }
  // Single fluid cells walled in by solid flip their momentum at every step for ever; two steps together do
  // not.
  double force = fluid.solid_force(1)[0];
  fluid.step();
  force = (force + fluid.solid_force(1)[0]) / 2;
  flux = (flux + fluid.momentum()[0]) / 2;
  long fluid_cells = 0;
  for_each_cell(fluid.decomposition().local_box(), [&](int x, int y, int z) {
    fluid_cells += fluid.is_solid({x, y, z}) ? 0 : 1;
  });
  return {nu * flux / g / (kSize * kSize * kSize), force / (g * static_cast<double>(fluid_cells)) - 1};
}

}  // namespace

TEST_CASE("permeability under TRT changes by less than 1e-6 between relaxation times 0.51 and 2") {
  const double reference = flow_through(1.0, CollisionOperator::trt).permeability;
  CHECK(reference > 0.05);
  for (const double tau : {0.51, 0.6, 0.8, 1.5, 2.0})
    CHECK(flow_through(tau, CollisionOperator::trt).permeability == Approx(reference).epsilon(1e-6));
}

TEST_CASE("under BGK the same cell's permeability depends on the viscosity") {
  const double at_one = flow_through(1.0, CollisionOperator::bgk).permeability;
  CHECK(flow_through(2.0, CollisionOperator::bgk).permeability / at_one > 1.5);
}

TEST_CASE("the grains take exactly the force that drives the fluid") {
  CHECK(std::abs(flow_through(0.8, CollisionOperator::trt).force_balance) < 1e-8);
  CHECK(std::abs(flow_through(0.8, CollisionOperator::central_moments).force_balance) < 1e-8);
}
