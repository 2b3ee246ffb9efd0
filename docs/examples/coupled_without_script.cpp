// Grains and water from C++, without a script for the water: what `lbm run` does, in the manner of the
// thesis's Appendix C. LIGGGHTS is opened as a library and told about the grains; CoupledSimulation owns the
// fluid.
//
//   mpirun -np 2 example_coupled_without_script
//
// Four spheres of 1 mm fall through water in a closed box; the program prints their mean height and speed and
// leaves settling.h5 and settling.xdmf for ParaView.
#include <fmt/format.h>
#include <mpi.h>

#include "atom.h"
#include "input.h"
#include "lammps.h"
#include "liggghts/liggghts_port.h"
#include "register_styles.h"
#include "suffuse/common/error.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/lbm/field_output.h"
#include "suffuse/lbm/whole_cells.h"

namespace {

using namespace suffuse;

constexpr const char* kGrains[] = {
    "units si",
    "atom_style granular",
    "atom_modify map array",
    "communicate single vel yes",
    "boundary f f f",
    "newton off",
    "region box block 0 8e-3 0 8e-3 0 16e-3 units box",
    "create_box 1 box",
    "neighbor 1e-4 bin",
    "neigh_modify delay 0",
    "fix e all property/global youngsModulus peratomtype 5e6",
    "fix nu all property/global poissonsRatio peratomtype 0.3",
    "fix cor all property/global coefficientRestitution peratomtypepair 1 0.7",
    "fix mu all property/global coefficientFriction peratomtypepair 1 0.3",
    "pair_style gran model hertz tangential history",
    "pair_coeff * *",
    "fix motion all nve/sphere",
    "fix weight all gravity 9.81 vector 0 0 -1",
    "fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0",
    "region corner block 2e-3 6e-3 2e-3 6e-3 10e-3 14e-3 units box",
    "lattice sc 3e-3",
    "create_atoms 1 region corner",
    "set type 1 diameter 1e-3 density 2650",
    "timestep 5e-6",
    "thermo 1000000",
};

coupling::CoupledSettings settings() {
  coupling::CoupledSettings s;
  s.units.density = 1000;
  s.units.viscosity = 1e-6;
  s.units.spacing = 2e-4;
  s.units.time_step = 1e-4;
  for (auto& face : s.fluid.faces) face.kind = lbm::FaceKind::no_slip;
  s.gravity = Vec3(0, 0, -9.81);
  s.substeps = 20;
  return s;
}

void run() {
  LAMMPS_NS::LAMMPS liggghts(0, nullptr, MPI_COMM_WORLD);
  register_styles(&liggghts);
  for (const char* line : kGrains) liggghts.input->one(line);

  coupling::LiggghtsPort grains(&liggghts);
  const coupling::CoupledSettings s = settings();
  const lbm::Index3 cells = lbm::whole_cells(grains.box_size(), *s.units.spacing, "example");
  coupling::CoupledSimulation simulation(s, grains.decomposition(grains.box_low(), *s.units.spacing, cells),
                                         grains.box_low(), grains);
  lbm::FieldOutputSettings fields;
  fields.path = "settling.h5";
  lbm::FieldOutput output(fields, simulation.units());

  constexpr int steps = 600, every = 200;
  grains.begin(steps * simulation.substeps());
  for (int step = 1; step <= steps; ++step) {
    simulation.step();
    if (step % every != 0) continue;
    output.write(simulation.fluid());
    double sums[3] = {0, 0, 0};
    for (int i = 0; i < liggghts.atom->nlocal; ++i) {
      sums[0] += liggghts.atom->x[i][2];
      sums[1] += liggghts.atom->v[i][2];
      sums[2] += 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0)
      fmt::print("time {:.3f} s: {} grains, mean height {:.3f} mm, mean velocity {:.1f} mm/s\n",
                 simulation.time_si(), sums[2], 1e3 * sums[0] / sums[2], 1e3 * sums[1] / sums[2]);
  }
  grains.end();
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    run();
  } catch (const UserError& error) {
    fmt::print(stderr, "{}\n", error.what());
    status = 1;
  }
  MPI_Finalize();
  return status;
}
