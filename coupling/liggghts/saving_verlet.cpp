#include "saving_verlet.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "../commands/interruption.h"
#include "../commands/saved_set.h"
#include "comm.h"
#include "fix.h"
#include "grains_file.h"
#include "lammps.h"
#include "modify.h"
#include "register_styles.h"
#include "restart_commands.h"
#include "restart_instant.h"
#include "signal_handling.h"
#include "styles/style_support.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/progress.h"
#include "suffuse/common/signal_watch.h"
#include "update.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kWho = "restart_set";
/// Steps between looks at signals and the clock, at most; fewer where so many take longer than this.
constexpr std::int64_t kLookEvery = 100;
constexpr double kLookSeconds = 0.1;
/// Between lines of progress, as of `fix stress/servo`.
constexpr std::chrono::seconds kProgressEvery{30};

/// A servo says itself how far it is: by its goal, where steps tell little.
bool some_fix_tells_progress(LAMMPS_NS::LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::string_view(lmp->modify->fix[i]->style) == "stress/servo") return true;
  return false;
}

/// LIGGGHTS would leave a fix that has come since the last set-up out of the run, or call it uninitialised.
void require_set_up_fixes(const LAMMPS_NS::LAMMPS* lmp) {
  const std::vector<std::string> ours = registered_styles();
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    const LAMMPS_NS::Fix& fix = *lmp->modify->fix[i];
    if (fix.just_created != 0 && std::ranges::binary_search(ours, std::string("fix ") + fix.style))
      throw_user_error({"run", "pre", "no", fmt::format("be yes: fix {} is new and not set up yet", fix.id),
                        "drop `pre no`"});
  }
}

bool has_words(int count, char** words, std::string_view first, std::string_view second) {
  for (int n = 0; n + 1 < count; ++n)
    if (first == words[n] && second == words[n + 1]) return true;
  return false;
}

}  // namespace

SavingVerlet::SavingVerlet(LAMMPS_NS::LAMMPS* lmp_in, SetRequest request)
    : Verlet(lmp_in, 0, nullptr), request_(std::move(request)) {}

void SavingVerlet::save() {
  set_up_again(lmp);
  const NewSet set = begin_set(request_.file, kWho, world);
  write_grains_file(lmp, set.grains, kWho);
  finish_set(request_.file, kWho, world);
}

void SavingVerlet::save_where_stopped(const std::string& file) {
  set_up_again(lmp);
  write_grains_file(lmp, file + ".part", "run");
  on_first_rank("run", world, [&] { std::filesystem::rename(file + ".part", file); });
}

int SavingVerlet::stop_here() const {
  if (comm->me == 0 && request_.limit.is_over()) return kWallLimitStops;
  return SignalWatch::received();
}

void SavingVerlet::end(int stop) {
  if (!request_.file.empty())
    throw Interrupted(exit_code_of_stop(stop),
                      fmt::format("restart_set: run stopped by {} after step {}; the state is in {}: go on "
                                  "with `read_restart {}.grains`",
                                  stop_name(stop), update->ntimestep, request_.file, request_.file));
  const std::string file = fmt::format("stopped_{}.restart", update->ntimestep);
  save_where_stopped(file);
  throw Interrupted(exit_code_of_stop(stop),
                    fmt::format("run: stopped by {} after step {}; the state is in {}: go on with "
                                "`read_restart {}` (`restart_set FILE every N` saves on the way)",
                                stop_name(stop), update->ntimestep, file, file));
}

/// On the screen alone: a log is the same however long a run took.
void SavingVerlet::tell_progress() {
  const Clock::time_point now = Clock::now();
  if (comm->me != 0 || screen == nullptr || now - told_ < kProgressEvery || some_fix_tells_progress(lmp))
    return;
  told_ = now;
  // `run N every M` comes in pieces: their end is not the run's.
  const std::int64_t end = update->beginstep == first_ ? update->endstep : update->laststep;
  const auto done = static_cast<double>(update->ntimestep - first_), all = static_cast<double>(end - first_);
  const double spent = std::chrono::duration<double>(now - began_).count();
  fmt::print(screen, "run: step {} of {} to {} ({:.0f} %), {} left\n", update->ntimestep, first_, end,
             100 * done / all, duration_text(spent * (all - done) / done));
  std::fflush(screen);
}

void SavingVerlet::run(int steps) {
  using enum SignalWatch::Second;
  const SignalWatch signals({{SIGTERM, noted}, {SIGUSR1, noted}, {SIGINT, as_usual}});
  const std::int64_t last = update->ntimestep + steps, every = request_.every;
  if (update->ntimestep != next_ || update->ntimestep == update->beginstep) {
    first_ = update->ntimestep;
    began_ = told_ = Clock::now();
  }
  std::int64_t look_every = 1;
  while (update->ntimestep < last) {
    const std::int64_t now = update->ntimestep;
    std::int64_t next = std::min(last, now + look_every);
    if (every > 0) next = std::min(next, (now / every + 1) * every);
    const Clock::time_point start = Clock::now();
    Verlet::run(static_cast<int>(next - now));
    const double a_step =
        std::chrono::duration<double>(Clock::now() - start).count() / static_cast<double>(next - now);
    double stop_and_time[2] = {static_cast<double>(stop_here()), a_step};
    MPI_Allreduce(MPI_IN_PLACE, stop_and_time, 2, MPI_DOUBLE, MPI_MAX, world);
    const int stop = static_cast<int>(stop_and_time[0]);
    look_every = std::clamp<std::int64_t>(std::llround(kLookSeconds / std::max(stop_and_time[1], 1e-9)), 1,
                                          std::min(kLookEvery, 2 * look_every));
    if (every > 0 && (update->ntimestep % every == 0 || stop != 0)) save();
    if (stop != 0) end(stop);
    tell_progress();
    next_ = update->ntimestep;
    if (LAMMPS_NS::SignalHandler::request_quit) return;  // a fix ends the run
  }
}

void run_watched(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  const bool not_set_up = lmp->update->first_update != 0 && has_words(narg, arg, "pre", "no");
  if (not_set_up) require_set_up_fixes(lmp);
  LAMMPS_NS::Integrate* const before = lmp->update->integrate;
  if (before == nullptr || typeid(*before) != typeid(LAMMPS_NS::Verlet))
    return run_until_stopped(lmp, narg, arg);
  struct PutBack {
    LAMMPS_NS::Update* update;
    LAMMPS_NS::Integrate *before, *watched;
    ~PutBack() {
      if (update->integrate == watched) {
        delete watched;
        update->integrate = before;
      } else {  // a command within the run has put another in its place, and deleted this one
        delete before;
      }
    }
  };
  auto* const watched = new SavingVerlet(lmp, {});
  lmp->update->integrate = watched;
  const PutBack put_back{lmp->update, before, watched};
  // LIGGGHTS's own, which tells the integrator what to tally, is left out by `pre no`.
  if (not_set_up) watched->init();
  run_until_stopped(lmp, narg, arg);
}

void restart_set(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  ArgumentReader reader(kWho, narg, arg, 0);
  auto* update = lmp->update;
  SetRequest request;
  request.file = reader.word("file, or off");
  std::unique_ptr<LAMMPS_NS::Integrate> integrate;
  if (request.file == "off" && reader.done()) {
    integrate = std::make_unique<LAMMPS_NS::Verlet>(lmp, 0, nullptr);
  } else {
    if (!reader.accept("every")) reader.unknown(reader.word("every"), "every N [stop after TIME]");
    request.every = reader.positive_integer("every");
    if (reader.accept("stop")) {
      if (!reader.accept("after")) reader.unknown(reader.word("after"), "after TIME");
      request.limit = WallLimit::read(reader);
    }
    if (!reader.done()) reader.unknown(reader.word("end of line"), "nothing more");
    if (std::string(update->integrate_style) != "verlet")
      throw_user_error({kWho, "run_style", update->integrate_style, "be verlet", "drop the `run_style`"});
    require_free_for_sets(request.file, kWho, lmp->world);
    integrate = std::make_unique<SavingVerlet>(lmp, request);
  }
  delete update->integrate;
  update->integrate = integrate.release();
  if (update->first_update != 0) update->integrate->init();  // which `run N pre no` leaves out
}

void require_no_sets_of_grains(LAMMPS_NS::LAMMPS* lmp, const std::string& who) {
  if (dynamic_cast<SavingVerlet*>(lmp->update->integrate) != nullptr)
    throw_user_error({who, "restart_set", "on", "be off: its sets have no water",
                      "write `restart_set off` before, and `lbm restart write FILE every T`"});
}

}  // namespace suffuse::coupling
