#include "lbm_command.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <map>

#include "../liggghts/force_fix.h"
#include "../liggghts/instance.h"
#include "../liggghts/restart_commands.h"
#include "../liggghts/restart_instant.h"
#include "driven_scene.h"
#include "lbm_accuracy.h"
#include "lbm_plan.h"
#include "lbm_run.h"
#include "lbm_words.h"
#include "register_styles.h"
#include "run_price.h"
#include "saved_set.h"
#include "styles/fix_hydrodynamic_force.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"
#include "suffuse/lbm/checkpoint.h"

namespace suffuse::coupling {

namespace {

using Instances = std::map<LAMMPS_NS::LAMMPS*, std::unique_ptr<LbmCommand>>;
Instances& instances() {
  static Instances all;
  return all;
}

void run_line(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  auto& instance = instances()[lmp];
  if (instance == nullptr) instance = std::make_unique<LbmCommand>(lmp);
  instance->line(narg, arg);
}

/// Words of the script that the averaged flow does not use; empty if there are none.
std::string unused_words_note(const LbmRequest& settings) {
  if (!settings.averaged) return "";
  std::vector<std::string> words;
  for (const std::string& word : settings.resolved_words) words.push_back("lbm " + word);
  if (settings.precision != lbm::Precision::double_precision) words.emplace_back("precision float");
  if (settings.average_force) words.emplace_back("average_force yes");
  if (words.empty()) return "";
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return fmt::format("lbm method averaged: note: not used: {}\n", fmt::join(words, ", "));
}

}  // namespace

void LbmCommand::add_to(LAMMPS_NS::LAMMPS* lmp) {
  WallLimit::start_clock();
  add_restart_commands(lmp);
  add_command(lmp, "lbm", &run_line);
}

void LbmCommand::remove_from(LAMMPS_NS::LAMMPS* lmp) {
  instances().erase(lmp);
}

void LbmCommand::line(int narg, char** arg) {
  const std::string word = narg > 0 ? arg[0] : "";
  const CommandFacts& facts = lbm_command(word);
  ArgumentReader reader("lbm " + word, narg, arg, 1);
  if (facts.only_before_run) refuse_after_start(word);
  if (read_request(word, reader, lmp_, request_)) return;
  if (word == "plan") {
    plan(reader);
  } else if (word == "accuracy") {
    accuracy(reader);
  } else if (word == "run") {
    run(reader);
  } else if (word == "restart") {
    restart(reader);
  } else if (word == "stop") {
    request_.wall_limit = read_stop(reader);
  } else {
    read_nothing(reader);
    clear();
  }
}

void LbmCommand::clear() {
  if (auto* fix = find_force_fix(lmp_)) fix->forget();
  simulation_.reset();
  port_.reset();
  effects_.withdraw(lmp_);
  effects_ = {};
  request_ = {};
  output_ = {};
  state_to_read_.clear();
  took_up_state_ = false;
  warned_about_held_grains_ = false;
  walls_ = {};
}

void LbmCommand::refuse_after_start(const std::string& word) const {
  if (simulation_ != nullptr)
    throw_user_error({"lbm " + word, "line", "after lbm run", "come before the first lbm run",
                      "move it up, or end the fluid with `lbm clear` first"});
}

void LbmCommand::require_lattice(const std::string& who) const {
  if (!request_.lattice_given)
    throw_user_error({who, "lattice", "none", "be defined before",
                      "write `lbm lattice spacing 4e-5 relaxation_time 0.8`, or `lbm accuracy 3%`"});
  require_box(lmp_, who);
}

void LbmCommand::restart(ArgumentReader& reader) {
  const RestartLine line = read_restart(reader);
  if (line.read) {
    refuse_after_start("restart read");
    on_first_rank(reader.who(), communicator_of(lmp_), [&] { state_to_read_ = fluid_of_set(line.file); });
    share_text(state_to_read_, communicator_of(lmp_));
  } else if (line.every) {
    const CheckpointRequest checkpoint{line.file, *line.every};
    request_.checkpoint.reset();
    refuse_shared_files(reader, request_, files_of(checkpoint));
    request_.checkpoint = checkpoint;
  } else if (simulation_ == nullptr) {
    throw_user_error({reader.who(), "fluid", "none", "exist", "write it after `lbm run`, or with `every T`"});
  } else {
    put_grains_in_order(lmp_);
    write_checkpoint(lmp_, *simulation_, output_.references(), line.file);
    (void)simulation_->map_anew();
  }
}

void LbmCommand::build() {
  CoupledSettings coupled = settings_for_grains(lmp_, request_, *port_);
  coupled.skip_rest = true;
  const EffectSettings effects = effects_.start(coupled, *port_, lmp_, state_to_read_);
  port_->check_box(coupled.fluid.faces);
  Vec3 low;
  const lbm::Decomposition parts = decomposition_of(lmp_, request_, *port_, low);
  coupled.substeps = choose_substeps();
  if (const std::string note = unused_words_note(request_); !note.empty()) tell(lmp_, note);
  simulation_ = std::make_unique<CoupledSimulation>(coupled, parts, low, *port_);
  require_walls(lmp_, request_.walls.open);
  simulation_->set_effects(effects);
  walls_.follow(scene(), request_.walls, state_to_read_);
  if (!state_to_read_.empty()) read_state();
}

/// Takes up the state that `lbm restart read` named.
void LbmCommand::read_state() {
  lbm::load_state(simulation_->fluid(), state_to_read_);
  if (!require_same_settings(state_to_read_, *simulation_))
    tell(lmp_, "lbm restart: note: " + state_to_read_ +
                   " does not say with which settings it was made; they must be those of this script "
                   "(docs/reference/lbm.md#restart)\n");
  if (port_->anything_moves() && !port_->loads_restored())
    throw_user_error(
        {"lbm restart", "read " + state_to_read_, "without the loads of the grains",
         "find them as they were saved",
         "write `fix hydrodynamic_force all hydrodynamic/force` right after `read_restart`, before "
         "any `run`"});
  const bool moves = port_->anything_moves();
  if (moves) require_grains_of(lmp_, state_to_read_);
  if (moves || (port_->loads_restored() && grains_are_of(lmp_, state_to_read_)))
    simulation_->continue_loads();
  load_pore_coefficients(state_to_read_, *simulation_);
  load_method(state_to_read_, *simulation_);
  output_.set_references(load_references(state_to_read_, communicator_of(lmp_)));
  took_up_state_ = true;
}

/// Their velocity moves the fluid although they stay where they are.
void LbmCommand::warn_about_held_grains() {
  if (warned_about_held_grains_) return;
  const LiggghtsPort::HeldInMotion held = port_->held_in_motion();
  if (held.grains == 0) return;
  warned_about_held_grains_ = true;
  tell(lmp_,
       fmt::format(
           "lbm run: note: {} that no fix moves still {} a velocity (up to {:.3g} m/s), which drags the "
           "water along; where that is not meant, write `velocity GROUP set 0 0 0` and `set group "
           "GROUP omegax 0 omegay 0 omegaz 0` (docs/reference/lbm.md#run)\n",
           count_text(held.grains, "grain"), held.grains == 1 ? "has" : "have", held.speed));
}

int LbmCommand::choose_substeps() {
  const int substeps = substeps_for(request_, *port_);
  port_->set_time_step(lbm::Units(request_.units).time_step() / substeps);
  return substeps;
}

void LbmCommand::accuracy(ArgumentReader& reader) {
  const AccuracyRequest request = read_accuracy(reader);
  if (request.accuracy) choose_lattice(request);
  require_lattice(reader.who());
  if (!request.file.empty()) write_lattice(lmp_, request_, request.file);
}

void LbmCommand::choose_lattice(const AccuracyRequest& request) {
  require_box(lmp_, "lbm accuracy");
  const bool made_port = port_ == nullptr;
  if (made_port) port_ = std::make_unique<LiggghtsPort>(lmp_);
  set_accuracy(lmp_, request, *port_, request_);
  if (made_port) forget_the_port();
}

void LbmCommand::plan(ArgumentReader& reader) {
  require_lattice(reader.who());
  const double time = read_plan(reader);
  if (port_ == nullptr) port_ = std::make_unique<LiggghtsPort>(lmp_);
  print_plan(lmp_, price_of_run(lmp_, request_, *port_), *port_,
             driven_scene(lmp_, *port_, request_, request_.units.largest_velocity, request_.region), time);
  if (simulation_ == nullptr) forget_the_port();
}

/// As if there had been none.
void LbmCommand::forget_the_port() {
  port_->withdraw();
  port_.reset();
}

void LbmCommand::run(ArgumentReader& reader) {
  require_lattice(reader.who());
  const RunLine asked = read_run(reader);
  if (asked.window >= asked.time && asked.steady)
    throw_user_error({reader.who(), "window", fmt::format("{:g} s", asked.window),
                      fmt::format("be shorter than the run, {:g} s", asked.time),
                      "two windows are compared: a twentieth of the time is the default"});
  if (port_ == nullptr) port_ = std::make_unique<LiggghtsPort>(lmp_);
  const double grain_step = port_->time_step();
  run_scene(reader, asked);
  port_->set_time_step(grain_step);  // the script's own: what it runs without water, and `substeps auto`
}

void LbmCommand::run_scene(const ArgumentReader& reader, const RunLine& asked) {
  RunRequest request;
  request.time = asked.time;
  request.steady = asked.steady;
  request.window =
      asked.window > 0 ? asked.window : asked.time / 20;  // of `until` too, however little is left
  if (request_.effects.buoyancy != Switch::off && !request_.gravity.is_zero()) refuse_double_buoyancy(lmp_);
  require_no_sets_of_grains(lmp_, reader.who());
  if (request_.wall_limit.given() && !request_.checkpoint)
    throw_user_error({"lbm stop", "after", request_.wall_limit.text(), "have a place for the state",
                      "write `lbm restart write FILE every T` before `lbm run`"});
  if (simulation_ == nullptr) {
    build();
  } else {
    port_->check_unchanged();
    const CoupledSettings now = settings_for_grains(lmp_, request_, *port_);
    port_->check_box(now.fluid.faces);
    const CoupledSettings& before = simulation_->settings();
    if (now.average_force != before.average_force || now.virtual_mass != before.virtual_mass)
      throw_user_error({"lbm couple",
                        now.average_force != before.average_force ? "average_force" : "virtual_mass",
                        "changed", "stay as it was at the first `lbm run`",
                        "write `lbm clear` before, and the scene anew"});
    simulation_->set_substeps(choose_substeps());
    simulation_->set_faces(now.fluid.faces);
    simulation_->set_gravity(now.gravity);
    (void)walls_.follow(scene(), request_.walls, "");
  }
  if (asked.until) {
    request.time -= simulation_->time_si();
    if (request.time < 0.5 * simulation_->units().time_step()) {
      port_->set_fluid_time(simulation_->time_si());
      tell(lmp_, fmt::format("lbm run: the fluid is at {:.6g} s already: nothing to run\n",
                             simulation_->time_si()));
      return;
    }
  }
  warn_about_held_grains();
  request.walls = walls_.lines();
  for (const std::string& line : effects_.begin(scene(), {request_.region, walls_.planes()}))
    tell(lmp_, "lbm run: " + line + "\n");
  LbmRun(scene(), request_, output_, effects_).run(request, took_up_state_);
  effects_.withdraw(lmp_);  // LIGGGHTS's own `run` is without water, and grains may become smaller by then
}

}  // namespace suffuse::coupling
