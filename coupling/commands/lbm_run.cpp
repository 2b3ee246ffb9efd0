#include "lbm_run.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "comm.h"
#include "interruption.h"
#include "lammps.h"
#include "manifest.h"
#include "suffuse/common/error.h"
#include "suffuse/common/progress.h"
#include "suffuse/common/signal_watch.h"
#include "suffuse/coupling/plane_sums.h"
#include "suffuse/lbm/health.h"
#include "water_walls.h"

namespace suffuse::coupling {

namespace {

/// Fluid steps between looks of the guards once a flow is near its limit.
constexpr long kCheckNearLimitEvery = 50;

/// Share of the grains' volume that may lie in other grains: contacts of the softest grains that are of use
/// stay well below.
constexpr double kLargestOverlap = 0.02;

/// Share by which two accelerations may differ and be the same, rounded by hand.
constexpr double kSameGravity = 2e-3;

}  // namespace

LbmRun::LbmRun(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& settings, LiggghtsPort& port,
               CoupledSimulation& simulation, RunOutput& output, RunEffects& effects)
    : lmp_(lmp),
      settings_(settings),
      port_(port),
      simulation_(simulation),
      output_(output),
      effects_(effects),
      guards_(settings.guards, simulation),
      census_(lmp) {
  guards_.set_warned(output.warned());
}

void LbmRun::say(const std::string& line) const {
  tell(lmp_, line + "\n");
}

void LbmRun::set_values() {
  simulation_.set_faces(faces_now(settings_, simulation_.units(), lmp_));
  simulation_.set_gravity(gravity_now(settings_, simulation_.units(), lmp_));
  simulation_.set_pressure_gradient(pressure_gradient_now(settings_, simulation_.units(), lmp_));
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

std::string LbmRun::details() const {
  const lbm::Index3& n = simulation_.fluid().decomposition().cells();
  const double cells = static_cast<double>(lbm::CellBox{{0, 0, 0}, n}.volume());
  const double done = static_cast<double>(simulation_.fluid().steps() - first_);
  return fmt::format("{:.5g} s  {:.1f} MLUPS  {}", simulation_.time_si(),
                     cells * done / std::max(1e-9, MPI_Wtime() - start_) * 1e-6,
                     simulation_.health_text(extremes_));
}

void LbmRun::check(long step) {
  // Before anything is written, too: nothing of a flow that is lost.
  const long every = near_limit_ ? kCheckNearLimitEvery : kCheckEvery;
  if (step % every != 0 && step != last_ && step != first_ && !output_.due(step)) return;
  const PlaneSums* sums = output_.sample_now(step, simulation_);
  const bool resolved = simulation_.method() == nullptr;
  extremes_ = sums != nullptr && resolved ? sums->extremes : simulation_.extremes();
  refuse_grains_behind_walls(simulation_);
  const GuardReading now = reading(extremes_);
  fastest_grain_ = std::max(fastest_grain_, now.fastest_grain);
  near_limit_ = resolved && lbm::mach_of(extremes_) > kWarnShare * settings_.largest_mach;
  const std::vector<std::string> warnings = guards_.look(now);
  for (const std::string& line : warnings) say(line);
  follow_effects();
  if (warnings.empty()) return;
  output_.set_warned(guards_.warned());
  if (step > first_) (void)output_.save(lmp_, port_, simulation_);  // while the state is still good
}

/// After the guards: nothing is decided by a flow that is lost.
void LbmRun::follow_effects() {
  report_.count(effects_, simulation_.fluid().steps());
  for (const std::string& line : effects_.look(lmp_, port_, simulation_, extremes_)) say("lbm run: " + line);
  MonitorReferences record;
  effects_.add_to(record);
  output_.set_effects(std::move(record));
}

void LbmRun::report_effects(double wall) {
  const long steps = simulation_.fluid().steps();
  report_.count(effects_, steps);
  const std::string file = effect_report_file(settings_);
  if (file.empty()) return;
  write_effect_report(file, report_.rows(lmp_, effects_, simulation_, wall), simulation_, wall,
                      steps - first_, lmp_->world);
}

GuardReading LbmRun::reading(const lbm::FluidExtremes& fluid) const {
  GuardReading now;
  now.fluid = fluid;
  if (simulation_.method() != nullptr) now.fluid.largest_speed = 0;  // no sound, no Mach number
  now.mach_limit = settings_.largest_mach;
  if (grains_ > 0) now.fastest_grain = port_.summary().speed;
  if (solid_volume_ > 0)
    now.overlap = simulation_.overlap() * std::pow(simulation_.units().spacing(), 3) / solid_volume_;
  now.lost_grains = census_.lost();
  read_budgets(now, simulation_);
  return now;
}

/// Where to go on from after a run that a guard has ended.
std::string LbmRun::with_last_state(const std::string& reason) const {
  const std::string state = output_.last_state();
  return fmt::format("{}; the run ended after fluid step {}, {}", reason, simulation_.fluid().steps(),
                     state.empty() ? "no state is saved: `lbm restart write FILE every T` before the run"
                                   : "the last good state is in " + state);
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

/// Everything up to the first step: LIGGGHTS's setup, the manifest, the grains in their cells, open files.
void LbmRun::begin(const RunRequest& request, std::optional<double> continue_after) {
  const lbm::Units& units = simulation_.units();
  const long steps = units.steps_in(request.time);
  if (const double dem_steps = units.time_to_lattice(request.time) * simulation_.substeps();
      dem_steps > MAXSMALLINT)
    throw_user_error({"lbm run", "time",
                      fmt::format("{:g} s, which are {:.3g} DEM steps", request.time, dem_steps),
                      fmt::format("be at most {:.3g} DEM steps", static_cast<double>(MAXSMALLINT)),
                      "split it in several `lbm run`"});
  if (std::any_of(settings_.outputs.begin(), settings_.outputs.end(),
                  [](const OutputRequest& output) { return output.contacts; }))
    port_.use_contacts();
  tell_meshes_beyond_periodic_faces(lmp_);
  tell_box_of_few_grains(lmp_);
  port_.set_fluid_time(simulation_.time_si());  // what LIGGGHTS's setup prints may ask for it
  port_.begin(steps * simulation_.substeps());
  port_.set_fluid_time(simulation_.time_si());
  set_values();
  const LiggghtsPort::Summary grains = port_.summary();
  grains_ = grains.grains;
  solid_volume_ = grains.solid_volume;
  for (const std::string& line : manifest(simulation_, grains, effects_.states(), request.walls))
    say("lbm run: " + line);
  if (const auto note = weight_note()) say(*note);
  simulation_.map();
  refuse_overlaps(grains);
  simulation_.times() = {};
  output_.prepare(settings_, lmp_, port_, simulation_, continue_after);
  follow_variables_ = values_change(settings_);
  first_ = simulation_.fluid().steps();
  last_ = first_ + steps;
  report_.begin(lmp_, effects_, simulation_);
  rested_ = simulation_.rested_steps();
  start_ = MPI_Wtime();
  check(first_);
  output_.write(lmp_, port_, simulation_);
}

/// One fluid step. LIGGGHTS writes its last lines in a step that it knows to be the last.
void LbmRun::advance(long step, bool is_last) {
  port_.check_unchanged();
  port_.set_fluid_time(simulation_.time_si());
  if (follow_variables_) set_values();
  if (output_.wants_values(step)) port_.announce_values(simulation_.substeps());
  if (output_.wants_contacts(step)) port_.announce_contacts(simulation_.substeps());
  if (is_last) port_.end_after(simulation_.substeps());
  bool loads_asked_for = is_last;
  for (long ahead = step; ahead < step + simulation_.loads_span(); ++ahead)
    loads_asked_for |= ahead == last_ || output_.due(ahead);
  simulation_.step(loads_asked_for);
}

/// What is due after a step; true if the flow has become steady.
bool LbmRun::look(long step, const RunRequest& request) {
  const double before = MPI_Wtime();
  check(step);
  if (output_.due(step)) output_.write(lmp_, port_, simulation_);
  const double window = request.window > 0 ? request.window : request.time / 20;
  const long steady_every = std::max(10L, simulation_.units().steps_in(window));
  bool steady = false;
  if (request.steady && (step - first_) % steady_every == 0) {
    simulation_.map();
    steady = is_steady(*request.steady);
    if (steady) simulation_.refresh_loads();  // the last step's refer to them
  }
  simulation_.times().output += MPI_Wtime() - before;
  return steady;
}

/// Saves the state where restart files were asked for, and says so.
std::string LbmRun::interruption_text(int signal) {
  const std::string where =
      fmt::format("lbm run: stopped by {} after fluid step {} ({:.6g} s)", stop_name(signal),
                  simulation_.fluid().steps(), simulation_.time_si());
  simulation_.map();
  if (const auto file = output_.save(lmp_, port_, simulation_))
    return fmt::format(
        "{}; the state is in {} and {}.grains: go on with `read_restart` and `lbm restart read`", where,
        *file, *file);
  return where + "; nothing saved: `lbm restart write FILE every T` before the run would have";
}

/// 0, or why this rank wants to stop.
int LbmRun::stop_here() const {
  if (lmp_->comm->me == 0 && settings_.wall_limit.is_over()) return kWallLimitStops;
  return SignalWatch::received();
}

std::string LbmRun::table(double wall) {
  const long made = simulation_.fluid().steps() - first_;
  const double grain_steps = port_.anything_moves() ? static_cast<double>(made) * simulation_.substeps() *
                                                          static_cast<double>(grains_)
                                                    : 0;
  return time_table(simulation_, made, grain_steps, wall);
}

/// What TRT does to the drag of grains as fast as these were, where it is more than a few
/// per cent.
std::optional<std::string> LbmRun::drag_note() const {
  const lbm::CollisionSettings& collision = simulation_.fluid().settings().collision;
  const lbm::Units& units = simulation_.units();
  const double speed = fastest_grain_ * units.spacing() / units.viscosity_si();
  const EffectState& comoving = effects_.state("comoving");
  if (simulation_.method() != nullptr || comoving.on || comoving.changes > 0) return std::nullopt;
  if (speed < kFastGrains.limit || collision.collision_operator != lbm::CollisionOperator::trt)
    return std::nullopt;
  return fmt::format(
      "lbm run: note: grains moved at up to {:.2g} viscosities a cell ({:.3g} m/s); a bed that carries its "
      "water along so fast has too much drag (7 % at 5, 49 % at 30); `lbm collision trt_comoving` leaves "
      "less than half of it (docs/what_goes_wrong.md)",
      speed, fastest_grain_);
}

/// Grains that weigh otherwise than the water: where that is meant to be their weight under water, buoyancy
/// would be counted twice.
std::optional<std::string> LbmRun::weight_note() const {
  const Vec3& water = simulation_.settings().gravity;
  if (water.isZero() || simulation_.effects().buoyancy == Switch::off || !port_.anything_moves())
    return std::nullopt;
  const auto grains = port_.gravity_on_grains();
  if (!grains || grains->isZero() || (*grains - water).norm() < kSameGravity * water.norm())
    return std::nullopt;
  return fmt::format(
      "lbm run: note: `fix gravity` weighs grains with {:.4g} m/s^2, `lbm force gravity` the water with "
      "{:.4g}: "
      "grains get the buoyancy of the water on top; a weight that is reduced by it counts it twice: give "
      "both "
      "the same g, or write `lbm effect buoyancy off` (docs/reference/lbm.md#effect)",
      grains->norm(), water.norm());
}

void LbmRun::run(const RunRequest& request, std::optional<double> continue_after) {
  // A second SIGINT acts as usual: whoever waits at a terminal can end the program at once. SIGUSR1 is what
  // mpirun passes on without killing its programs a second later.
  using enum SignalWatch::Second;
  const SignalWatch signals({{SIGTERM, noted}, {SIGUSR1, noted}, {SIGINT, as_usual}});
  begin(request, continue_after);
  const double steps = static_cast<double>(last_ - first_);
  ProgressLine progress(lmp_->comm->me == 0);
  bool is_last = false, steady = false;
  int stop = 0;
  for (long step = first_ + 1; step <= last_ && !steady && stop == 0; ++step) {
    steady = is_last;
    try {
      advance(step, is_last);
      is_last = look(step, request);
    } catch (const LostRun& end) {  // on all ranks alike
      throw LostRun(with_last_state(end.what()));
    }
    progress.update(static_cast<double>(step - first_) / steps, [this] { return details(); });
    stop = port_.stop_requested(stop_here());
  }
  const bool interrupted = stop > LiggghtsPort::kFixStops;
  const std::string last_words = interrupted ? interruption_text(stop) : "";
  const double made = static_cast<double>(simulation_.fluid().steps() - first_);
  simulation_.refresh_loads();
  port_.end();
  port_.set_fluid_time(simulation_.time_si());
  progress.finish(details(), interrupted ? made / steps : 1);
  census_.tell_lost();
  const double wall = MPI_Wtime() - start_;
  report_effects(wall);
  const std::string where_time_went = table(wall);
  if (request.steady)
    say(fmt::format("lbm run: {} after {:.5g} s", steady ? "steady" : "not yet steady",
                    simulation_.units().time_to_si(made)));
  say(where_time_went);
  if (const long rested = simulation_.rested_steps() - rested_; rested > 0)
    say(fmt::format("lbm run: water at rest that nothing moves: no lattice in {} of {:.0f} steps", rested,
                    made));
  if (const auto note = drag_note()) say(*note);
  if (interrupted) throw Interrupted(exit_code_of_stop(stop), last_words);
}

}  // namespace suffuse::coupling
