#pragma once

// Spheres in a box of fluid for the coupling's tests. Everything in lattice units: the spacing is 1 m, the
// fluid's step 1 s and its density 1 kg/m^3, so that SI and lattice values are the same numbers.

#include <memory>
#include <utility>
#include <vector>

#include "lbm_test_tools.h"
#include "prescribed_grains.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling::test {

/// How solids are treated when a script says nothing, the coefficient found from the pores around each
/// sphere.
inline SolidSettings default_solids() {
  return {};
}

/// The same with a coefficient that depends on the diameter (cells) and the share of the neighbourhood that
/// is solid alone.
inline SolidSettings fixed_solids(double diameter, double share = 0) {
  SolidSettings solids;
  solids.automatic_coefficient = false;
  solids.cells.coefficient = 1.35 + (6.5 + 6 * share + 54 * share * share) / diameter;
  return solids;
}

/// The thesis's: SC1, Noble and Torczynski's weighting, 5^3 sub-cells (its collision is BGK).
inline SolidSettings thesis_solids() {
  SolidSettings solids;
  solids.automatic_coefficient = false;
  solids.cells.solid_operator = lbm::SolidOperator::sc1;
  solids.cells.weighting = lbm::SolidWeighting::noble_torczynski;
  solids.fraction = FractionMethod::subcells;
  solids.subcells = 5;
  return solids;
}

inline CoupledSettings lattice_settings(double relaxation_time, const SolidSettings& solids) {
  CoupledSettings settings;
  settings.units.density = 1;
  settings.units.viscosity = lbm::viscosity_of(relaxation_time);
  settings.units.spacing = 1;
  settings.units.relaxation_time = relaxation_time;
  settings.solids = solids;
  settings.substeps = 1;
  return settings;
}

inline CoupledSettings thesis_settings(double relaxation_time) {
  CoupledSettings settings = lattice_settings(relaxation_time, thesis_solids());
  settings.fluid.collision.collision_operator = lbm::CollisionOperator::bgk;
  return settings;
}

using lbm::Index3;

inline PrescribedGrains::Grain sphere_at(const Vec3& position, double radius, double density = 2.65) {
  PrescribedGrains::Grain grain;
  grain.position = position;
  grain.radius = radius;
  grain.density = density;
  return grain;
}

/// A simulation with its grains, on all ranks of a communicator.
class Scene {
 public:
  Scene(const CoupledSettings& settings, const Index3& cells, std::vector<PrescribedGrains::Grain> list,
        MPI_Comm communicator = MPI_COMM_WORLD)
      : grains(std::move(list), Vec3(cells[0], cells[1], cells[2]), periodic(settings),
               1. / settings.substeps, communicator),
        simulation(std::make_unique<CoupledSimulation>(
            settings, lbm::Decomposition::balanced(communicator, cells), Vec3::Zero(), grains)) {}

  void run(long steps) {
    for (long n = 0; n < steps; ++n) simulation->step();
  }
  /// Load on a grain in the last step, held grains included.
  Vec3 force(std::size_t n = 0) {
    simulation->refresh_loads();
    return grains.force_on(n);
  }
  Vec3 torque(std::size_t n = 0) {
    simulation->refresh_loads();
    return grains.torque_on(n);
  }

  PrescribedGrains grains;
  std::unique_ptr<CoupledSimulation> simulation;

 private:
  static std::array<bool, 3> periodic(const CoupledSettings& settings) {
    const auto kind = [&](std::size_t face) { return settings.fluid.faces[face].kind; };
    return {kind(0) == lbm::FaceKind::periodic, kind(2) == lbm::FaceKind::periodic,
            kind(4) == lbm::FaceKind::periodic};
  }
};

}  // namespace suffuse::coupling::test
