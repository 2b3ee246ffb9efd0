#include "saving_verlet.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <memory>

#include "../commands/interruption.h"
#include "../commands/saved_set.h"
#include "comm.h"
#include "grains_file.h"
#include "lammps.h"
#include "restart_instant.h"
#include "signal_handling.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/common/signal_watch.h"
#include "update.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kWho = "restart_set";
/// Steps between looks at signals and the clock, at most.
constexpr std::int64_t kLookEvery = 100;

}  // namespace

SavingVerlet::SavingVerlet(LAMMPS_NS::LAMMPS* lmp_in, SetRequest request)
    : Verlet(lmp_in, 0, nullptr), request_(std::move(request)) {}

void SavingVerlet::save() {
  set_up_again(lmp);
  const NewSet set = begin_set(request_.file, kWho, world);
  write_grains_file(lmp, set.grains, kWho);
  finish_set(request_.file, kWho, world);
}

int SavingVerlet::stop_here() const {
  if (comm->me == 0 && request_.limit.is_over()) return kWallLimitStops;
  return SignalWatch::received();
}

void SavingVerlet::run(int steps) {
  using enum SignalWatch::Second;
  const SignalWatch signals({{SIGTERM, noted}, {SIGUSR1, noted}, {SIGINT, as_usual}});
  const std::int64_t last = update->ntimestep + steps, every = request_.every;
  while (update->ntimestep < last) {
    const std::int64_t now = update->ntimestep;
    const std::int64_t next = std::min({last, (now / every + 1) * every, now + kLookEvery});
    Verlet::run(static_cast<int>(next - now));
    int stop = stop_here();
    MPI_Allreduce(MPI_IN_PLACE, &stop, 1, MPI_INT, MPI_MAX, world);
    const bool due = update->ntimestep % every == 0;
    if (due || stop != 0) save();
    if (stop != 0)
      throw Interrupted(exit_code_of_stop(stop),
                        fmt::format("restart_set: run stopped by {} after step {}; the state is in {}: go on "
                                    "with `read_restart {}.grains`",
                                    stop_name(stop), update->ntimestep, request_.file, request_.file));
    if (LAMMPS_NS::SignalHandler::request_quit) return;  // a fix ends the run
  }
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
}

void require_no_sets_of_grains(LAMMPS_NS::LAMMPS* lmp, const std::string& who) {
  if (dynamic_cast<SavingVerlet*>(lmp->update->integrate) != nullptr)
    throw_user_error({who, "restart_set", "on", "be off: its sets have no water",
                      "write `restart_set off` before, and `lbm restart write FILE every T`"});
}

}  // namespace suffuse::coupling
