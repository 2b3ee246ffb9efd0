#include "lbm_run.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../liggghts/instance.h"
#include "interruption.h"
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

LbmRun::LbmRun(const Scene& scene, const LbmRequest& settings, RunOutput& output, RunEffects& effects)
    : scene_(scene),
      settings_(settings),
      output_(output),
      effects_(effects),
      guards_(settings.guards, scene.simulation),
      census_(scene.lmp) {
  guards_.set_warned(output.warned());
}

void LbmRun::say(const std::string& line) const {
  tell(scene_.lmp, line + "\n");
}

void LbmRun::set_values() {
  scene_.simulation.set_faces(faces_now(settings_, scene_.simulation.units(), scene_.lmp));
  scene_.simulation.set_gravity(gravity_now(settings_, scene_.simulation.units(), scene_.lmp));
  scene_.simulation.set_pressure_gradient(
      pressure_gradient_now(settings_, scene_.simulation.units(), scene_.lmp));
}

void LbmRun::refuse_overlaps(const LiggghtsPort::Summary& grains) const {
  const double cell = std::pow(scene_.simulation.units().spacing(), 3);
  const double share = grains.solid_volume > 0 ? scene_.simulation.overlap() * cell / grains.solid_volume : 0;
  if (share > kLargestOverlap)
    throw_user_error({"lbm run", "grains",
                      fmt::format("overlapping by {:.1f} % of their volume", 100 * share),
                      fmt::format("overlap by less than {:g} %", 100 * kLargestOverlap),
                      "settle or separate them before, or take stiffer contacts"});
}

std::string LbmRun::details() {
  const lbm::Index3& n = scene_.simulation.fluid().decomposition().cells();
  const double cells = static_cast<double>(lbm::CellBox{{0, 0, 0}, n}.volume());
  const long made = scene_.simulation.fluid().steps() - first_;
  return lbm::progress_details(fmt::format("{:.5g} s", scene_.simulation.time_si()), cells,
                               static_cast<double>(made - rested_steps()), MPI_Wtime() - start_,
                               scene_.simulation.health_text(extremes_));
}

void LbmRun::check(long step) {
  // Before anything is written, too: nothing of a flow that is lost.
  const long every = near_limit_ ? kCheckNearLimitEvery : kCheckEvery;
  if (step % every != 0 && step != last_ && step != first_ && !output_.due(step)) return;
  const PlaneSums* sums = output_.sample_now(step, scene_.simulation);
  const bool resolved = scene_.simulation.method() == nullptr;
  extremes_ = sums != nullptr && resolved ? sums->extremes : scene_.simulation.extremes();
  refuse_grains_behind_walls(scene_.simulation);
  const GuardReading now = reading(extremes_);
  fastest_grain_ = std::max(fastest_grain_, now.fastest_grain);
  near_limit_ = resolved && lbm::mach_of(extremes_) > kWarnShare * settings_.largest_mach;
  const std::vector<std::string> warnings = guards_.check(now);
  for (const std::string& line : warnings) say(line);
  follow_effects();
  if (warnings.empty()) return;
  output_.set_warned(guards_.warned());
  if (step > first_) (void)output_.save(scene_);  // while the state is still good
}

/// After the guards: nothing is decided by a flow that is lost.
void LbmRun::follow_effects() {
  report_.count(effects_, scene_.simulation.fluid().steps());
  for (const std::string& line : effects_.check(scene_, extremes_)) say("lbm run: " + line);
  MonitorReferences record;
  effects_.add_to(record);
  output_.set_effects(std::move(record));
}

void LbmRun::report_effects(double wall) {
  const long steps = scene_.simulation.fluid().steps();
  report_.count(effects_, steps);
  const std::string file = effect_report_file(settings_);
  if (file.empty()) return;
  write_effect_report(file, report_.rows(scene_.lmp, effects_, scene_.simulation, wall), scene_.simulation,
                      wall, steps - first_, communicator_of(scene_.lmp));
}

GuardReading LbmRun::reading(const lbm::FluidExtremes& fluid) const {
  GuardReading now;
  now.fluid = fluid;
  if (scene_.simulation.method() != nullptr) now.fluid.largest_speed = 0;  // no sound, no Mach number
  now.mach_limit = settings_.largest_mach;
  const LiggghtsPort::Summary grains = scene_.port.summary();  // as they are: some may have come in or gone
  now.fastest_grain =  // dry ones may fall as they like, but not be lost
      std::isfinite(grains.speed) ? fastest_wet_grain(scene_.port, scene_.simulation) : grains.speed;
  if (grains.solid_volume > 0)
    now.overlap =
        scene_.simulation.overlap() * std::pow(scene_.simulation.units().spacing(), 3) / grains.solid_volume;
  now.lost_grains = census_.lost();
  read_budgets(now, scene_.simulation);
  return now;
}

/// Where to go on from after a run that a guard has ended.
std::string LbmRun::with_last_state(const std::string& reason) const {
  const std::string state = output_.last_state();
  return fmt::format("{}; the run ended after fluid step {}, {}", reason, scene_.simulation.fluid().steps(),
                     state.empty() ? "no state is saved: `lbm restart write FILE every T` before the run"
                                   : "the last good state is in " + state);
}

/// Of the water between the grains, and of the grains.
lbm::MeanMotion LbmRun::mean_motion() {
  const double before = MPI_Wtime();
  const PlaneSums planes = plane_sums(scene_.simulation.map(), 2);
  lbm::MeanMotion mean;
  mean.flow = planes.superficial_velocity();
  for (const Vec3& flux : planes.solid_flux) mean.carried += flux / static_cast<double>(planes.planes());
  scene_.simulation.times().output += MPI_Wtime() - before;
  return mean;
}

/// Everything up to the first step: LIGGGHTS's setup, the manifest, the grains in their cells, open files.
void LbmRun::begin(const RunRequest& request, bool took_up_state) {
  const lbm::Units& units = scene_.simulation.units();
  const long steps = units.steps_in(request.time);
  if (const double dem_steps = units.time_to_lattice(request.time) * scene_.simulation.substeps();
      dem_steps > RunControl::kMostSteps)
    throw_user_error({"lbm run", "time",
                      fmt::format("{:g} s, which are {:.3g} DEM steps", request.time, dem_steps),
                      fmt::format("be at most {:.3g} DEM steps", static_cast<double>(RunControl::kMostSteps)),
                      "split it in several `lbm run`"});
  if (std::any_of(settings_.outputs.begin(), settings_.outputs.end(),
                  [](const OutputRequest& output) { return output.contacts; }))
    scene_.port.use_contacts();
  tell_meshes_beyond_periodic_faces(scene_.lmp);
  tell_box_of_few_grains(scene_.lmp);
  scene_.port.set_fluid_time(scene_.simulation.time_si());  // what LIGGGHTS's setup prints may ask for it
  scene_.port.begin(steps * scene_.simulation.substeps());
  scene_.port.set_fluid_time(scene_.simulation.time_si());
  set_values();
  const LiggghtsPort::Summary grains = scene_.port.summary();
  grains_ = grains.grains;
  for (const std::string& line : manifest(scene_.simulation, grains, effects_.states(), request.walls))
    say("lbm run: " + line);
  if (const auto note = weight_note()) say(*note);
  const MappedScene mapped = scene_.simulation.map();
  refuse_overlaps(grains);
  scene_.simulation.times() = {};
  output_.prepare(settings_, scene_, mapped, took_up_state);
  follow_variables_ = values_change(settings_);
  first_ = scene_.simulation.fluid().steps();
  last_ = first_ + steps;
  report_.begin(scene_.lmp, effects_, scene_.simulation);
  rested_ = scene_.simulation.rested_steps();
  start_ = MPI_Wtime();
  check(first_);
  output_.write(scene_);
}

void LbmRun::advance(long step, bool cut_short) {
  if (cut_short) scene_.simulation.refresh_loads();  // those of this step refer to them
  scene_.port.check_unchanged();
  scene_.port.set_fluid_time(scene_.simulation.time_si());
  if (follow_variables_) set_values();
  if (output_.wants_values(step)) scene_.port.announce_values(scene_.simulation.substeps());
  if (output_.wants_contacts(step)) scene_.port.announce_contacts(scene_.simulation.substeps());
  if (cut_short) scene_.port.end_after(scene_.simulation.substeps());
  bool loads_asked_for = cut_short;
  for (long ahead = step; ahead < step + scene_.simulation.loads_span(); ++ahead)
    loads_asked_for |= ahead == last_ || output_.due(ahead);
  scene_.simulation.step(loads_asked_for);
}

void LbmRun::check_due(long step) {
  const double before = MPI_Wtime();
  check(step);
  if (output_.due(step)) output_.write(scene_);
  scene_.simulation.times().output += MPI_Wtime() - before;
}

/// Saves the state where restart files were asked for, and says so.
std::string LbmRun::interruption_text(int signal) {
  const std::string where =
      fmt::format("lbm run: stopped by {} after fluid step {} ({:.6g} s)", stop_name(signal),
                  scene_.simulation.fluid().steps(), scene_.simulation.time_si());
  scene_.simulation.map();
  if (const auto file = output_.save(scene_))
    return fmt::format(
        "{}; the state is in {} and {}.grains: go on with `read_restart` and `lbm restart read`", where,
        *file, *file);
  return where + "; nothing saved: `lbm restart write FILE every T` before the run would have";
}

/// Some rank's signal, the wall limit, or a fix of the script.
int LbmRun::stop_requested() {
  const bool is_over = is_first_rank(scene_.lmp) && settings_.wall_limit.is_over();
  return scene_.port.stop_requested(is_over ? kWallLimitStops : SignalWatch::received());
}

std::string LbmRun::table(double wall) {
  const long made = scene_.simulation.fluid().steps() - first_;
  const double grain_steps =
      scene_.port.anything_moves()
          ? static_cast<double>(made) * scene_.simulation.substeps() * static_cast<double>(grains_)
          : 0;
  return time_table(scene_.simulation, made, rested_steps(), grain_steps, wall);
}

/// What TRT does to the drag of grains as fast as these were, where it is more than a few
/// per cent.
std::optional<std::string> LbmRun::drag_note() const {
  const lbm::CollisionSettings& collision = scene_.simulation.fluid().settings().collision;
  const lbm::Units& units = scene_.simulation.units();
  const double speed = fastest_grain_ * units.spacing() / units.viscosity_si();
  const EffectState& comoving = effects_.state("comoving");
  if (scene_.simulation.method() != nullptr || comoving.on || comoving.changes > 0) return std::nullopt;
  if (speed < kFastGrains.limit || collision.collision_operator != lbm::CollisionOperator::trt)
    return std::nullopt;
  return fmt::format(
      "lbm run: note: grains moved at up to {:.2g} viscosities a cell ({:.3g} m/s); a bed that carries its "
      "water along so fast has too much drag (2 to 5 % at 5, 6 to 16 % at 10); `lbm collision trt_comoving` "
      "keeps within 2 % (docs/what_goes_wrong.md)",
      speed, fastest_grain_);
}

/// Grains that weigh otherwise than the water: where that is meant to be their weight under water, buoyancy
/// would be counted twice.
std::optional<std::string> LbmRun::weight_note() const {
  const Vec3& water = scene_.simulation.settings().gravity;
  if (water.isZero() || scene_.simulation.effects().buoyancy == Switch::off || !scene_.port.anything_moves())
    return std::nullopt;
  const auto grains = scene_.port.gravity_on_grains();
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

void LbmRun::run(const RunRequest& request, bool took_up_state) {
  // A second SIGINT acts as usual: whoever waits at a terminal can end the program at once. SIGUSR1 is what
  // mpirun passes on without killing its programs a second later.
  using enum SignalWatch::Second;
  const SignalWatch signals({{SIGTERM, noted}, {SIGUSR1, noted}, {SIGINT, as_usual}});
  begin(request, took_up_state);
  lbm::RunPlan plan{first_, last_};
  plan.until_steady = request.steady;
  plan.steady_every = std::max(10L, scene_.simulation.units().steps_in(request.window));
  plan.ends_with_a_step = true;  // LIGGGHTS writes its last lines in a step that it knows to be the last
  ProgressLine progress(is_first_rank(scene_.lmp));
  lbm::RunEnd end;
  try {
    end = lbm::run_loop(*this, plan, progress);
  } catch (const LostRun& lost) {  // on all ranks alike
    throw LostRun(with_last_state(lost.what()));
  }
  conclude(request, end, progress);
}

/// The last words of a run.
void LbmRun::conclude(const RunRequest& request, const lbm::RunEnd& end, ProgressLine& progress) {
  const double steps = static_cast<double>(last_ - first_);
  const bool interrupted = end.stop > LiggghtsPort::kFixStops;
  const std::string last_words = interrupted ? interruption_text(end.stop) : "";
  const double made = static_cast<double>(scene_.simulation.fluid().steps() - first_);
  scene_.simulation.refresh_loads();
  scene_.port.end();
  scene_.port.set_fluid_time(scene_.simulation.time_si());
  progress.finish(details(), interrupted ? made / steps : 1);
  census_.tell_lost();
  const double wall = MPI_Wtime() - start_;
  report_effects(wall);
  const std::string where_time_went = table(wall);
  if (request.steady)
    say("lbm run: " + lbm::steadiness_text(end.steady, scene_.simulation.units().time_to_si(made)));
  say(where_time_went);
  if (const long rested = rested_steps(); rested > 0)
    say(fmt::format("lbm run: water at rest that nothing moves: no lattice in {} of {:.0f} steps", rested,
                    made));
  if (const auto note = drag_note()) say(*note);
  if (interrupted) throw Interrupted(exit_code_of_stop(end.stop), last_words);
}

}  // namespace suffuse::coupling
