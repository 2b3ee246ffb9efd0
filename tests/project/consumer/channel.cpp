// On the installed libraries: the flow between two plates, its mean beside Poiseuille's, and Terzaghi's
// gradient of a bed.
#include <fmt/format.h>
#include <mpi.h>

#include <cmath>

#include "suffuse/lbm/fluid.h"
#include "suffuse/micromechanics/seepage.h"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  double mean = 0;
  constexpr int width = 8;
  constexpr double force = 1e-5;
  suffuse::lbm::FluidSettings settings;
  for (auto& face : settings.faces) face.kind = suffuse::lbm::FaceKind::periodic;
  settings.faces[4].kind = settings.faces[5].kind = suffuse::lbm::FaceKind::no_slip;
  {
    suffuse::lbm::Fluid fluid(settings, suffuse::lbm::Decomposition::balanced(MPI_COMM_WORLD, {2, 2, width}));
    fluid.set_force({force, 0, 0});
    for (int step = 0; step < 4000; ++step) fluid.step();
    mean = fluid.momentum()[0] / (2 * 2 * width);
  }
  const double viscosity = (settings.collision.relaxation_time - 0.5) / 3;
  // The parabola's mean over the cells' centres, where TRT's default has it exactly.
  const double poiseuille = force * (width * width + 0.5) / (12 * viscosity);
  fmt::print("mean velocity {:.6g}, Poiseuille {:.6g}; Terzaghi {:.4f}\n", mean, poiseuille,
             suffuse::micromechanics::critical_gradient(0.4, 2650));
  MPI_Finalize();
  return std::abs(mean / poiseuille - 1) < 1e-4 ? 0 : 1;
}
