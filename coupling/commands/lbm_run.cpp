#include "lbm_run.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "comm.h"
#include "lammps.h"
#include "manifest.h"
#include "suffuse/common/error.h"
#include "suffuse/common/progress.h"
#include "suffuse/coupling/plane_sums.h"
#include "suffuse/lbm/health.h"

namespace suffuse::coupling {

namespace {

/// Fluid steps between looks at Mach number and density: sound crosses this many cells meanwhile.
constexpr long kCheckEvery = 100;

/// Share of the grains' volume that may lie in other grains: contacts of the softest grains that are of use
/// stay well below.
constexpr double kLargestOverlap = 0.02;

}  // namespace

LbmRun::LbmRun(LAMMPS_NS::LAMMPS* lmp, const LbmSettings& settings, LiggghtsPort& port,
               CoupledSimulation& simulation, RunOutput& output)
    : lmp_(lmp),
      settings_(settings),
      port_(port),
      simulation_(simulation),
      output_(output),
      speaks_(lmp->comm->me == 0) {}

void LbmRun::say(const std::string& line) const {
  tell(lmp_, line + "\n");
}

void LbmRun::set_values() {
  simulation_.set_faces(faces_now(settings_, simulation_.units(), lmp_));
  simulation_.set_gravity(settings_.gravity.now(lmp_));
  simulation_.set_pressure_gradient(settings_.pressure_gradient.now(lmp_));
}

void LbmRun::refuse_overlaps(const LiggghtsPort::Summary& grains) const {
  const double cell = std::pow(simulation_.units().spacing(), 3);
  const double share = grains.solid_volume > 0 ? simulation_.overlap() * cell / grains.solid_volume : 0;
  if (share > kLargestOverlap)
    throw_user_error({"lbm run", "grains",
                      fmt::format("overlapping by {:.1f} % of their volume", 100 * share),
                      fmt::format("overlap by less than {:g} %", 100 * kLargestOverlap),
                      "settle or separate them before, or take stiffer contacts"});
}

std::string LbmRun::details(long done) const {
  const lbm::Index3& n = simulation_.fluid().decomposition().cells();
  const double cells = static_cast<double>(lbm::CellBox{{0, 0, 0}, n}.volume());
  return fmt::format("{:.5g} s  {:.1f} MLUPS  {}", simulation_.time_si(),
                     cells * static_cast<double>(done) / std::max(1e-9, MPI_Wtime() - start_) * 1e-6,
                     lbm::health_text(extremes_));
}

void LbmRun::check(long step, long first, long last) {
  if (step % kCheckEvery != 0 && step != last && step != first) return;
  extremes_ = simulation_.fluid().extremes();
  lbm::require_stable(extremes_, simulation_.units(), simulation_.time_si(), settings_.largest_mach,
                      "lbm run");
}

/// Compares flow and motion with those of the last call. Ripples of a share of the flow count for the grains
/// too: at rest they tremble.
bool LbmRun::is_steady(double share) {
  const PlaneSums planes = plane_sums(simulation_, 2);
  const Vec3 flow = planes.superficial_velocity();
  Vec3 motion = Vec3::Zero();
  for (const Vec3& flux : planes.solid_flux) motion += flux / static_cast<double>(planes.planes());
  const bool steady = last_flow_ && (flow - *last_flow_).norm() <= share * flow.norm() &&
                      (motion - *last_motion_).norm() <= share * std::max(flow.norm(), motion.norm());
  last_flow_ = flow;
  last_motion_ = motion;
  return steady;
}

void LbmRun::run(const RunRequest& request, const std::vector<EffectChoice>& effects,
                 std::optional<double> continue_after) {
  const lbm::Units& units = simulation_.units();
  const long steps = steps_in(request.time, units);
  if (const double dem_steps = units.time_to_lattice(request.time) * simulation_.substeps();
      dem_steps > MAXSMALLINT)
    throw_user_error({"lbm run", "time",
                      fmt::format("{:g} s, which are {:.3g} DEM steps", request.time, dem_steps),
                      fmt::format("be at most {:.3g} DEM steps", static_cast<double>(MAXSMALLINT)),
                      "split it in several `lbm run`"});
  const double window = request.window > 0 ? request.window : request.time / 20;
  const long steady_every = std::max(10L, steps_in(window, units));
  if (std::any_of(settings_.outputs.begin(), settings_.outputs.end(),
                  [](const OutputRequest& output) { return output.contacts; }))
    port_.use_contacts();
  port_.begin(steps * simulation_.substeps());
  set_values();
  const LiggghtsPort::Summary grains = port_.summary();
  for (const std::string& line : manifest(simulation_, grains, effects)) say("lbm run: " + line);
  simulation_.map();
  refuse_overlaps(grains);
  simulation_.times() = {};
  output_.prepare(settings_, lmp_, port_, simulation_, continue_after);
  const bool follow_variables = values_change(settings_);
  const long first = simulation_.fluid().steps(), last = first + steps;
  start_ = MPI_Wtime();
  output_.write(lmp_, port_, simulation_);
  check(first, first, last);
  ProgressLine progress(speaks_);
  bool ending = false;
  bool steady = false;
  for (long step = first + 1; step <= last && !steady; ++step) {
    steady = ending;  // LIGGGHTS writes its last lines in a step that it knows to be the last
    port_.check_unchanged();
    if (follow_variables) set_values();
    if (output_.wants_values(step)) port_.announce_values(simulation_.substeps());
    if (output_.wants_contacts(step)) port_.announce_contacts(simulation_.substeps());
    if (ending) port_.end_after(simulation_.substeps());
    simulation_.step();
    {
      const double before = MPI_Wtime();
      if (output_.due(step)) output_.write(lmp_, port_, simulation_);
      check(step, first, last);
      if (request.steady && !ending && (step - first) % steady_every == 0) {
        simulation_.map();
        ending = is_steady(*request.steady);
      }
      simulation_.times().output += MPI_Wtime() - before;
    }
    progress.update(static_cast<double>(step - first) / static_cast<double>(steps), details(step - first));
    if (port_.stop_requested()) break;
  }
  simulation_.refresh_loads();
  port_.end();
  progress.finish(details(simulation_.fluid().steps() - first));
  const long made = simulation_.fluid().steps() - first;
  const double wall = MPI_Wtime() - start_;
  const double grain_steps = port_.anything_moves() ? static_cast<double>(made) * simulation_.substeps() *
                                                          static_cast<double>(grains.grains)
                                                    : 0;
  const std::string table = time_table(simulation_, made, grain_steps, wall);
  if (request.steady)
    say(fmt::format("lbm run: {} after {:.5g} s", steady ? "steady" : "not yet steady",
                    units.time_to_si(static_cast<double>(made))));
  say(table);
}

}  // namespace suffuse::coupling
