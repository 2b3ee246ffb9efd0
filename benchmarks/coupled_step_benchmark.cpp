// A dense bed of moving spheres in water: what each part of a coupled step costs, as a share of the bare
// in-place update of the fluid's 19 arrays timed in turns within one run. Spheres are moved at given
// velocities: the discrete-element code is not part of this (see dense_bed.py for the whole).
//
//   coupled_step_benchmark                    one core
//   scripts/mpirun 2 .../coupled_step_benchmark   two
//   coupled_step_benchmark --write_bed FILE   the spheres' centres, a line each, cells
//
// The scene: 7,958 equal spheres of 5 cells diameter, at random without overlap, in 84 x 84 x 168 cells with
// no-slip walls (solid fraction 0.439).
#include <benchmark/benchmark.h>
#include <mpi.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "mpi_benchmarks.h"
#include "prescribed_grains.h"
#include "random_packing.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace {

using namespace suffuse;
using namespace suffuse::coupling;

constexpr lbm::Index3 kCells{84, 84, 168};
constexpr double kDiameter = 5;
constexpr int kGrains = 7958;

struct Scene {
  std::string name;
  lbm::Precision precision;
  FractionMethod fraction;
  bool moving, automatic;
};

std::vector<PrescribedGrains::Grain> bed() {
  PackingRequest request;
  request.box = Vec3(kCells[0], kCells[1], kCells[2]);
  request.periodic = {false, false, false};
  request.radii.assign(kGrains, kDiameter / 2);
  static const std::vector<Vec3> centres = random_packing(request);
  std::vector<PrescribedGrains::Grain> grains;
  for (const Vec3& centre : centres) {
    PrescribedGrains::Grain g;
    g.position = centre;
    g.radius = kDiameter / 2;
    grains.push_back(g);
  }
  return grains;
}

CoupledSettings settings_of(const Scene& scene) {
  CoupledSettings settings;
  settings.units.density = 1;
  settings.units.viscosity = 0.1 / 3;
  settings.units.spacing = 1;
  settings.units.time_step = 1;
  settings.fluid.precision = scene.precision;
  for (auto& face : settings.fluid.faces) face.kind = lbm::FaceKind::no_slip;
  settings.solids.fraction = scene.fraction;
  settings.solids.automatic_coefficient = scene.automatic;
  settings.solids.cells.coefficient = 4;
  // Whenever it is their turn: not a multiple of the four steps after which grains are back where they were.
  settings.solids.survey_every = 50;  // as a bed whose fastest grains make 0.01 cells a step
  settings.solids.survey_distance = 0;
  settings.substeps = 1;
  return settings;
}

double slowest(double mine) {
  double all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return all;
}

void run_scene(benchmark::State& state, const Scene& scene) {
  PrescribedGrains grains(bed(), Vec3(kCells[0], kCells[1], kCells[2]), {false, false, false}, 1.);
  grains.mobile = scene.moving;
  if (scene.moving) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> speed(-0.01, 0.01);
    for (auto& g : grains.list) g.velocity = Vec3(speed(random), speed(random), speed(random));
  }
  CoupledSimulation simulation(settings_of(scene), lbm::Decomposition::balanced(MPI_COMM_WORLD, kCells),
                               Vec3::Zero(), grains);
  const double cells = static_cast<double>(lbm::CellBox{{0, 0, 0}, kCells}.volume());
  const int steps = scene.automatic ? 50 : 18;  // one survey a turn
  for (int n = 0; n < 2; ++n) simulation.step();
  std::vector<double> bare, fluid, mapping, exchange, shares;
  for (auto _ : state) {
    MPI_Barrier(MPI_COMM_WORLD);
    double start = MPI_Wtime();
    for (int n = 0; n < steps; ++n) simulation.fluid().bare_update();
    bare.push_back(slowest(MPI_Wtime() - start) / steps);
    simulation.times() = {};
    MPI_Barrier(MPI_COMM_WORLD);
    start = MPI_Wtime();
    for (int n = 0; n < steps; ++n) {
      simulation.step();
      for (auto& g : grains.list)
        if (scene.moving && n % 2 == 1) g.velocity = -g.velocity;
    }
    const CoupledTimes& times = simulation.times();
    fluid.push_back(slowest(times.fluid) / steps);
    mapping.push_back(slowest(times.mapping) / steps);
    exchange.push_back(slowest(times.exchange) / steps);
    shares.push_back((fluid.back() + mapping.back() + exchange.back()) / bare.back());
    state.SetIterationTime(fluid.back() + mapping.back() + exchange.back());
  }
  state.counters["bare_ms"] = 1e3 * median(bare);
  state.counters["fluid_ms"] = 1e3 * median(fluid);
  state.counters["mapping_ms"] = 1e3 * median(mapping);
  state.counters["exchange_ms"] = 1e3 * median(exchange);
  state.counters["per_bare"] = median(shares);
  state.counters["solids_per_fluid"] = (median(mapping) + median(exchange)) / median(fluid);
  state.counters["surveys"] = static_cast<double>(simulation.surveys());
  state.counters["MLUPS"] = cells * 1e-6 / (median(fluid) + median(mapping) + median(exchange));
  state.counters["bytes_per_cell"] =
      static_cast<double>(simulation.bytes()) /
      static_cast<double>(simulation.fluid().decomposition().local_box().volume());
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (argc == 3 && std::string(argv[1]) == "--write_bed") {
    std::ofstream file(argv[2]);
    for (const auto& grain : bed())
      file << grain.position[0] << ' ' << grain.position[1] << ' ' << grain.position[2] << '\n';
    MPI_Finalize();
    return file.good() ? 0 : 1;
  }
  benchmark::Initialize(&argc, argv);
  std::vector<Scene> scenes;
  for (const lbm::Precision precision : {lbm::Precision::double_precision, lbm::Precision::float_precision}) {
    const std::string storage = precision == lbm::Precision::double_precision ? "/double" : "/float";
    scenes.push_back({"moving/linear" + storage, precision, FractionMethod::linear, true, false});
    scenes.push_back({"moving/exact" + storage, precision, FractionMethod::exact, true, false});
    scenes.push_back({"moving/exact/automatic" + storage, precision, FractionMethod::exact, true, true});
    scenes.push_back({"moving/subcells" + storage, precision, FractionMethod::subcells, true, false});
    scenes.push_back({"at_rest/exact" + storage, precision, FractionMethod::exact, false, false});
  }
  run_benchmarks(scenes, run_scene, 11, rank);
  MPI_Finalize();
  return 0;
}
