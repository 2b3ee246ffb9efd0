#include "run_control.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

#include "domain.h"
#include "fix.h"
#include "force_fix.h"
#include "grain_questions.h"
#include "integrate.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "signal_handling.h"
#include "styles/early_stop.h"
#include "styles/fix_contact_sampler.h"
#include "styles/fix_hydrodynamic_force.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"
#include "timer.h"
#include "update.h"

namespace suffuse::coupling {

using LAMMPS_NS::bigint;
using LAMMPS_NS::FixHydrodynamicForce;
using LAMMPS_NS::LAMMPS;

RunControl::RunControl(LAMMPS* lmp) : lmp_(lmp) {
  keep_box();
}

void RunControl::keep_box() {
  std::copy_n(lmp_->domain->boxlo, 3, box_.begin());
  std::copy_n(lmp_->domain->boxhi, 3, box_.begin() + 3);
}

namespace {

constexpr std::int64_t kNoStep = std::numeric_limits<std::int64_t>::max();

/// Styles whose work in a step is done anew in the next one, or that have none while grains stay where they
/// are: forces, and what is kept with grains, meshes and lists. Others count, or change something.
constexpr std::string_view kOfTheMoment[] = {"freeze",
                                             "setforce",
                                             "aveforce",
                                             "planeforce",
                                             "lineforce",
                                             "enforce2d",
                                             "gravity",
                                             "addforce",
                                             "buoyancy",
                                             "viscous",
                                             "drag",
                                             "wall/gran",
                                             "property/atom",
                                             "property/global",
                                             "contacthistory",
                                             "contacthistory/mesh",
                                             "neighlist/mesh",
                                             "mesh/surface",
                                             "mesh/surface/planar",
                                             "contact/sampler",
                                             "hydrodynamic/force",
                                             "lubrication",
                                             "store/force"};

}  // namespace

/// Is there something that `run` would do in every step, although no fix integrates motion? Held grains that
/// have a velocity all the same load their contacts in every step.
bool RunControl::acts_in_every_step() const {
  using namespace LAMMPS_NS::FixConst;
  constexpr int in_a_step = INITIAL_INTEGRATE | POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | PRE_FORCE |
                            POST_FORCE | PRE_FINAL_INTEGRATE | FINAL_INTEGRATE | PRE_INITIAL_INTEGRATE;
  for (int i = 0; i < lmp_->modify->nfix; ++i) {
    const std::string_view style = lmp_->modify->fix[i]->style;
    const bool of_the_moment =
        std::find(std::begin(kOfTheMoment), std::end(kOfTheMoment), style) != std::end(kOfTheMoment);
    if ((lmp_->modify->fmask[i] & in_a_step) != 0 && !of_the_moment) return true;
  }
  return GrainQuestions(lmp_).held_in_motion().grains > 0;
}

/// The next step of held grains that has to be made: one of a fix that acts at its end, or with an output or
/// values that somebody asks for.
std::int64_t RunControl::next_step_that_counts() const {
  const std::int64_t now = lmp_->update->ntimestep;
  if (every_step_) return now + 1;
  std::int64_t next = lmp_->output->next > now ? lmp_->output->next : kNoStep;
  if (announced_step_ > now) next = std::min(next, announced_step_);
  for (int i = 0; i < lmp_->modify->nfix; ++i) {
    const std::int64_t every = lmp_->modify->fix[i]->nevery;
    if ((lmp_->modify->fmask[i] & LAMMPS_NS::FixConst::END_OF_STEP) != 0 && every > 0)
      next = std::min(next, (now / every + 1) * every);
  }
  return next;
}

bool RunControl::makes_a_step_within(int substeps) const {
  return moves_ || next_step_that_counts() <= lmp_->update->ntimestep + substeps;
}

void RunControl::set_time_step(double step) {
  constexpr double round_off = 1e-9;
  if (std::abs(step - lmp_->update->dt) <= round_off * step) return;
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (const std::string style = lmp_->modify->fix[i]->style; style == "move")
      throw_user_error(
          {"lbm run", "timestep", fmt::format("{:g} s", lmp_->update->dt),
           fmt::format("be {:.10g} s, a whole part of the fluid's step: `fix move` does not let it "
                       "be changed",
                       step),
           fmt::format("write `timestep {:.10g}` before `fix {} ... move`", step, lmp_->modify->fix[i]->id)});
  lmp_->update->update_time();
  lmp_->update->dt = step;
  if (lmp_->update->integrate != nullptr) lmp_->update->integrate->reset_dt();
  for (int i = 0; i < lmp_->modify->nfix; ++i) lmp_->modify->fix[i]->reset_dt();
}

static_assert(RunControl::kMostSteps == MAXSMALLINT);

void RunControl::begin(std::int64_t steps) {
  auto* update = lmp_->update;
  if (update->ntimestep + steps > MAXBIGINT || steps > kMostSteps)
    throw_user_error({"lbm run", "time", fmt::format("{} DEM steps", steps),
                      fmt::format("be at most {} DEM steps", kMostSteps), "split it in several `lbm run`"});
  force_fix(lmp_).set_in_water(true);
  moves_ = GrainQuestions(lmp_).anything_moves();
  announced_step_ = -1;
  update->nsteps = static_cast<int>(steps);
  update->firststep = update->beginstep = update->ntimestep;
  update->laststep = update->endstep = update->ntimestep + steps;
  update->whichflag = 1;
  EarlyStop::requested = false;
  lmp_->init();
  every_step_ = !moves_ && acts_in_every_step();
  running_ = true;
  update->integrate->setup();
  lmp_->timer->init();
  keep_box();
}

/// Grains that nothing moves leave nothing to integrate: then the clock of LIGGGHTS goes on alone to the
/// steps that count.
void RunControl::make_steps(int substeps) {
  auto* update = lmp_->update;
  const bigint last = update->ntimestep + substeps;
  if (moves_ || every_step_) {
    update->integrate->run(substeps);
    return;
  }
  for (std::int64_t next = next_step_that_counts(); next <= last; next = next_step_that_counts()) {
    update->ntimestep = next - 1;
    update->integrate->run(1);
    if (LAMMPS_NS::SignalHandler::request_quit) return;  // a fix ends the run
  }
  update->ntimestep = last;
}

void RunControl::end_after(int substeps) {
  auto* update = lmp_->update;
  auto* output = lmp_->output;
  update->laststep = update->endstep = update->ntimestep + substeps;
  output->next_thermo = std::min(output->next_thermo, update->laststep);
  output->next = std::min(output->next, update->laststep);
  lmp_->modify->addstep_compute(update->laststep);
}

void RunControl::end() {
  if (!running_) return;
  running_ = false;
  if (auto* fix = find_force_fix(lmp_)) fix->set_in_water(false);
  auto* update = lmp_->update;
  update->integrate->cleanup();
  update->whichflag = 0;
  update->firststep = update->laststep = 0;
  update->beginstep = update->endstep = 0;
  if (EarlyStop::requested) LAMMPS_NS::SignalHandler::request_quit = false;
}

void RunControl::set_fluid_time(double seconds) {
  using enum FixHydrodynamicForce::Fluid;
  if (auto* fix = find_force_fix(lmp_)) fix->set_fluid_time(seconds, running_ ? flows : rests);
}

int RunControl::stop_requested(int signal) const {
  int mine = std::max(signal, LAMMPS_NS::SignalHandler::request_quit ? kFixStops : 0), any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, lmp_->world);
  return any;
}

void RunControl::announce_values(int substeps) {
  announced_step_ = lmp_->update->ntimestep + substeps;
  lmp_->modify->addstep_compute(announced_step_);
}

void RunControl::use_contacts() {
  require_granular_pair_style(lmp_, "lbm output ... contacts");
  LAMMPS_NS::FixContactSampler::of(lmp_);
}

void RunControl::announce_contacts(int substeps) {
  announced_step_ = lmp_->update->ntimestep + substeps;
  LAMMPS_NS::FixContactSampler::of(lmp_).request(announced_step_, true);
}

void RunControl::check_unchanged() const {
  const auto* domain = lmp_->domain;
  for (std::size_t a = 0; a < 3; ++a)
    if (box_[a] != domain->boxlo[a] || box_[a + 3] != domain->boxhi[a])
      throw_user_error({"lbm run", "box", "deforming", "keep its size while there is a fluid",
                        "unfix the servo or `fix deform` before, or end the fluid with `lbm clear`"});
}

}  // namespace suffuse::coupling
