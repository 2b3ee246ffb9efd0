#include "lbm_run.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>

#include "comm.h"
#include "lammps.h"
#include "suffuse/common/progress.h"

namespace suffuse::coupling {

LbmRun::LbmRun(LAMMPS_NS::LAMMPS* lmp, const LbmSettings& settings, LiggghtsPort& port,
               CoupledSimulation& simulation)
    : lmp_(lmp), settings_(settings), port_(port), simulation_(simulation), speaks_(lmp->comm->me == 0) {}

void LbmRun::set_values() {
  simulation_.set_faces(faces_now(settings_, simulation_.units(), lmp_));
  simulation_.set_gravity(settings_.gravity.now(lmp_));
  simulation_.set_pressure_gradient(settings_.pressure_gradient.now(lmp_));
}

void LbmRun::run(const RunRequest& request) {
  const double step = simulation_.units().time_step();
  const long steps = std::max(1L, std::lround(request.time / step));
  port_.begin(steps * simulation_.substeps());
  set_values();
  const bool follow_variables = values_change(settings_);
  ProgressLine progress(speaks_);
  for (long n = 0; n < steps; ++n) {
    port_.check_unchanged();
    if (follow_variables) set_values();
    simulation_.step();
    if (port_.stop_requested()) break;
  }
  simulation_.refresh_loads();
  port_.end();
}

}  // namespace suffuse::coupling
