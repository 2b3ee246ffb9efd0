// A step of the fluid against the bare in-place update of its 19 arrays, timed in turns within one run.
//
//   lbm_step_benchmark                                    one core
//   mpirun -np 2 lbm_step_benchmark                       one rank a core; the box is shared out
//   SUFFUSE_INSTRUCTION_SET=avx2 lbm_step_benchmark       another kernel
//
// Counters: share = time of the bare update / time of a step (1 is the memory's limit), MLUPS of both, bytes
// a cell.
#include <benchmark/benchmark.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "mpi_benchmarks.h"
#include "suffuse/lbm/fluid.h"

namespace {

using namespace suffuse;
using namespace suffuse::lbm;

struct Scene {
  std::string name;
  Index3 cells;
  FluidSettings settings;
  Vec3 force = Vec3::Zero();
};

FaceConditions walls_and_pressures() {
  FaceConditions faces;
  for (auto& face : faces) face.kind = FaceKind::no_slip;
  faces[4] = {FaceKind::pressure, Vec3::Zero(), 1.001};
  faces[5] = {FaceKind::pressure, Vec3::Zero(), 1.0};
  return faces;
}

/// Seconds that `sweeps` calls take on the slowest rank.
template <class Body>
double seconds(int sweeps, Body&& body) {
  MPI_Barrier(MPI_COMM_WORLD);
  const auto start = std::chrono::steady_clock::now();
  for (int n = 0; n < sweeps; ++n) body();
  double mine = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return all;
}

void run_scene(benchmark::State& state, const Scene& scene) {
  Fluid fluid(scene.settings, Decomposition::balanced(MPI_COMM_WORLD, scene.cells));
  fluid.set_force(scene.force);
  const double cells = static_cast<double>(CellBox{{0, 0, 0}, scene.cells}.volume());
  const int sweeps = std::max(2, 2 * static_cast<int>(5e6 / cells));  // even: both kinds of step
  fluid.run(2);
  std::vector<double> ratios, bare_times, step_times;
  for (auto _ : state) {
    bare_times.push_back(seconds(sweeps, [&] { fluid.bare_update(); }) / sweeps);
    step_times.push_back(seconds(sweeps, [&] { fluid.step(); }) / sweeps);
    ratios.push_back(bare_times.back() / step_times.back());
    state.SetIterationTime(step_times.back());
  }
  state.counters["share"] = median(ratios);
  // Where others use the machine meanwhile: the best of each, as if it had been quiet.
  state.counters["share_best"] = *std::min_element(bare_times.begin(), bare_times.end()) /
                                 *std::min_element(step_times.begin(), step_times.end());
  state.counters["MLUPS"] = cells / median(step_times) * 1e-6;
  state.counters["bare_MLUPS"] = cells / median(bare_times) * 1e-6;
  state.counters["bytes_per_cell"] =
      static_cast<double>(fluid.bytes()) / static_cast<double>(fluid.decomposition().local_box().volume());
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  const auto add = [&](const std::string& what, int size, Precision precision, auto&& change) {
    Scene scene;
    scene.cells = {size, size, size};
    scene.settings.precision = precision;
    scene.settings.faces = walls_and_pressures();
    change(scene);
    scene.name =
        what + (precision == Precision::double_precision ? "/double/" : "/float/") + std::to_string(size);
    all.push_back(scene);
  };
  const auto as_it_is = [](Scene&) {};
  for (const Precision precision : {Precision::double_precision, Precision::float_precision}) {
    for (const int size : {64, 128, 256}) add("trt", size, precision, as_it_is);
    add("trt_odd", 125, precision, as_it_is);  // rows that end within a register
    add("trt_periodic", 128, precision, [](Scene& s) { s.settings.faces = FaceConditions{}; });
    add("trt_force", 128, precision, [](Scene& s) { s.force = Vec3(0, 0, 1e-6); });
    add("trt_incompressible", 128, precision, [](Scene& s) { s.settings.collision.incompressible = true; });
    add("bgk", 128, precision,
        [](Scene& s) { s.settings.collision.collision_operator = CollisionOperator::bgk; });
    add("trt_smagorinsky", 128, precision, [](Scene& s) { s.settings.collision.smagorinsky = 0.1; });
    add("trt_comoving", 128, precision,
        [](Scene& s) { s.settings.collision.collision_operator = CollisionOperator::trt_comoving; });
    add("trt_comoving_force", 128, precision, [](Scene& s) {
      s.settings.collision.collision_operator = CollisionOperator::trt_comoving;
      s.force = Vec3(0, 0, 1e-6);
    });
    add("central_moments", 128, precision,
        [](Scene& s) { s.settings.collision.collision_operator = CollisionOperator::central_moments; });
    add("central_moments_smagorinsky", 128, precision, [](Scene& s) {
      s.settings.collision.collision_operator = CollisionOperator::central_moments;
      s.settings.collision.smagorinsky = 0.1;
    });
    add("thin_sub_box", 32, precision, [](Scene& s) {
      int ranks = 1;
      MPI_Comm_size(MPI_COMM_WORLD, &ranks);
      s.cells[2] = 32 * ranks;
    });
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  benchmark::Initialize(&argc, argv);
  run_benchmarks(scenes(), run_scene, 21, rank);
  MPI_Finalize();
  return 0;
}
