// The averaged flow on several ranks, and after a pause: the same to the last digit.
#include <mpi.h>

#include <catch2/catch.hpp>
#include <random>
#include <utility>

#include "prescribed_grains.h"
#include "suffuse/coupling/coupled_simulation.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

constexpr double kSpacing = 1e-3;
const lbm::Index3 kCells{4, 4, 6};

std::vector<PrescribedGrains::Grain> cloud() {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<PrescribedGrains::Grain> grains;
  for (int n = 0; n < 150; ++n) {
    PrescribedGrains::Grain g;
    for (int a = 0; a < 3; ++a)
      g.position[a] = kSpacing * kCells[static_cast<std::size_t>(a)] * (0.05 + 0.9 * share(random));
    for (int a = 0; a < 3; ++a) g.velocity[a] = 1e-2 * (2 * share(random) - 1);
    g.radius = 2e-4 * (0.5 + share(random));
    grains.push_back(g);
  }
  return grains;
}

/// Every `ranks`-th grain, from `rank` on, with flow from below and periodic sides.
struct Run {
  Run(MPI_Comm communicator, int rank, int ranks)
      : grains(part(rank, ranks), kSpacing * Vec3(4, 4, 6), {true, true, false}, 1e-3, communicator),
        simulation(settings(), lbm::Decomposition::balanced(communicator, kCells), Vec3::Zero(), grains) {
    grains.mobile = true;
  }
  static std::vector<PrescribedGrains::Grain> part(int rank, int ranks) {
    const auto all = cloud();
    std::vector<PrescribedGrains::Grain> mine;
    for (std::size_t n = static_cast<std::size_t>(rank); n < all.size(); n += static_cast<std::size_t>(ranks))
      mine.push_back(all[n]);
    return mine;
  }
  static CoupledSettings settings() {
    CoupledSettings settings;
    settings.units.spacing = kSpacing;
    settings.units.time_step = 1e-3;
    settings.units.only_cells_and_steps = true;
    settings.averaged.emplace();
    settings.substeps = 1;
    settings.fluid.faces[4] = {lbm::FaceKind::velocity,
                               lbm::Units(settings.units).velocity_to_lattice(Vec3(0, 0, 0.02))};
    settings.fluid.faces[5] = {lbm::FaceKind::pressure};
    return settings;
  }
  void steps(int count) {
    for (int n = 0; n < count; ++n) simulation.step();
  }
  std::vector<double> state() const {
    std::vector<double> all;
    for (const auto& [name, values] : simulation.method()->state())
      all.insert(all.end(), values->begin(), values->end());
    return all;
  }
  PrescribedGrains grains;
  CoupledSimulation simulation;
};

}  // namespace

TEST_CASE("Any number of ranks gives the same digits") {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Run together(MPI_COMM_WORLD, rank, ranks), alone(MPI_COMM_SELF, 0, 1);
  together.steps(8);
  alone.steps(8);
  CHECK(together.state() == alone.state());
  bool same = true;
  for (std::size_t n = 0; n < together.grains.list.size(); ++n)
    same &= together.grains.force_on(n) ==
            alone.grains.force_on(static_cast<std::size_t>(rank) + n * static_cast<std::size_t>(ranks));
  CHECK(same);
}

TEST_CASE("A state that is put back goes on as if there had been no pause") {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Run whole(MPI_COMM_WORLD, rank, ranks), later(MPI_COMM_WORLD, rank, ranks);
  whole.steps(4);
  later.grains.list = whole.grains.list;
  auto to = later.simulation.method()->state();
  const auto from = whole.simulation.method()->state();
  for (std::size_t n = 0; n < to.size(); ++n) *to[n].second = *from[n].second;
  whole.steps(4);
  later.steps(4);
  CHECK(whole.state() == later.state());
  CHECK(whole.grains.force_on(0) == later.grains.force_on(0));
}
