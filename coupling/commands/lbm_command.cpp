#include "lbm_command.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "../liggghts/fluid_box.h"
#include "../liggghts/instance.h"
#include "../liggghts/restart_commands.h"
#include "../liggghts/restart_instant.h"
#include "lbm_accuracy.h"
#include "lbm_plan.h"
#include "lbm_run.h"
#include "register_styles.h"
#include "saved_set.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"
#include "suffuse/lbm/checkpoint.h"
#include "suffuse/lbm/whole_cells.h"

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

/// Closures are means over several grains.
void require_cells_of_grains(double spacing, const LiggghtsPort::Summary& grains) {
  constexpr double least = 1.5, rounding = 1e-9;
  if (grains.grains > 0 && spacing < least * grains.sauter_diameter * (1 - rounding))
    throw_user_error({"lbm lattice", "spacing", fmt::format("{:g} m", spacing),
                      fmt::format("be at least {:g} mean diameters, {:.3g} m, with `lbm method averaged`",
                                  least, least * grains.sauter_diameter),
                      fmt::format("about three, {:.2g} m, is usual", 3 * grains.sauter_diameter)});
}

/// Words of the script that the averaged flow does not use; empty if there are none.
std::string unused_words_note(const LbmSettings& settings) {
  if (!settings.coupled.averaged) return "";
  std::vector<std::string> words;
  for (const std::string& word : settings.resolved_words) words.push_back("lbm " + word);
  if (settings.coupled.fluid.precision != lbm::Precision::double_precision)
    words.emplace_back("precision float");
  if (settings.coupled.average_force) words.emplace_back("average_force yes");
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
  static const char* known =
      "method, preset, fluid, lattice, boundary, force, collision, solid, walls, effect, couple, guard, "
      "monitor, "
      "output, plan, accuracy, run, restart, stop, clear";
  const std::string word = narg > 0 ? arg[0] : "";
  ArgumentReader reader("lbm " + word, narg, arg, 1);
  const std::map<std::string, void (*)(ArgumentReader&, LbmSettings&)> before_start{
      {"method", read_method},   {"preset", read_preset},       {"fluid", read_fluid},
      {"lattice", read_lattice}, {"collision", read_collision}, {"solid", read_solid},
      {"walls", read_walls},     {"effect", read_effect}};
  if (const auto reading = before_start.find(word); reading != before_start.end()) {
    refuse_after_start(word);
    reading->second(reader, settings_);
    if (word == "preset" || word == "collision" || word == "solid") settings_.resolved_words.push_back(word);
  } else if (word == "boundary") {
    read_boundary(reader, lmp_, settings_);
  } else if (word == "force") {
    read_force(reader, lmp_, settings_);
  } else if (word == "couple") {
    read_couple(reader, settings_);
  } else if (word == "guard") {
    read_guard(reader, settings_);
  } else if (word == "monitor") {
    read_monitor(reader, settings_);
  } else if (word == "output") {
    read_output(reader, settings_);
  } else if (word == "plan") {
    plan(reader);
  } else if (word == "accuracy") {
    refuse_after_start(word);
    accuracy(reader);
  } else if (word == "run") {
    run(reader);
  } else if (word == "restart") {
    restart(reader);
  } else if (word == "stop") {
    if (!reader.accept("after")) reader.unknown(reader.word("after"), "after TIME");
    settings_.wall_limit = WallLimit::read(reader);
  } else if (word == "clear") {
    simulation_.reset();
    port_.reset();
    effects_.withdraw(lmp_);
    effects_ = {};
    settings_ = {};
    output_ = {};
    state_to_read_.clear();
    continued_at_.reset();
    warned_about_held_grains_ = false;
    walls_ = {};
  } else {
    throw_user_error({"lbm", "word", word.empty() ? "nothing" : word, std::string("be one of: ") + known,
                      "see docs/reference/lbm.md"});
  }
  if (!reader.done()) reader.unknown(reader.word("end of line"), "nothing more");
}

void LbmCommand::refuse_after_start(const std::string& word) const {
  if (simulation_ != nullptr)
    throw_user_error({"lbm " + word, "line", "after lbm run", "come before the first lbm run",
                      "move it up, or end the fluid with `lbm clear` first"});
}

void LbmCommand::require_lattice(const std::string& who) const {
  if (!settings_.lattice_given)
    throw_user_error({who, "lattice", "none", "be defined before",
                      "write `lbm lattice spacing 4e-5 relaxation_time 0.8`, or `lbm accuracy 3%`"});
  require_box(lmp_, who);
}

void LbmCommand::restart(ArgumentReader& reader) {
  const std::string mode = reader.word("write or read");
  const std::string file = reader.word("file");
  if (mode == "read") {
    refuse_after_start("restart read");
    on_first_rank(reader.who(), communicator_of(lmp_), [&] { state_to_read_ = fluid_of_set(file); });
    share_text(state_to_read_, communicator_of(lmp_));
  } else if (mode == "write") {
    if (reader.accept("every")) {
      const CheckpointRequest checkpoint{file, reader.positive("every")};
      settings_.checkpoint.reset();
      refuse_shared_files(reader, settings_, files_of(checkpoint));
      settings_.checkpoint = checkpoint;
    } else if (simulation_ == nullptr) {
      throw_user_error(
          {reader.who(), "fluid", "none", "exist", "write it after `lbm run`, or with `every T`"});
    } else {
      put_grains_in_order(lmp_);
      write_checkpoint(lmp_, *simulation_, output_.references(), file);
      (void)simulation_->map_anew();
    }
  } else {
    reader.unknown(mode, "write, read");
  }
}

/// With values of now; everything that `auto` leaves open is still open.
CoupledSettings LbmCommand::settings_now() const {
  const lbm::Units units(settings_.coupled.units);
  CoupledSettings coupled = settings_.coupled;
  coupled.fluid.faces = faces_now(settings_, units, lmp_);
  coupled.gravity = gravity_now(settings_, units, lmp_);
  coupled.pressure_gradient = pressure_gradient_now(settings_, units, lmp_);
  if (coupled.averaged) require_cells_of_grains(units.spacing(), port_->summary());
  return coupled;
}

/// LIGGGHTS's sub-boxes over the cells of the fluid's box; `low` is set to its low corner.
lbm::Decomposition LbmCommand::decomposition(Vec3& low) {
  const double spacing = lbm::Units(settings_.coupled.units).spacing();
  const FluidBox box = fluid_box(lmp_, *port_, settings_.region);
  low = box.low;
  return port_->decomposition(box.low, spacing, lbm::whole_cells(box.size, spacing, "lbm lattice"));
}

void LbmCommand::build() {
  CoupledSettings coupled = settings_now();
  coupled.skip_rest = true;
  const EffectSettings effects = effects_.start(coupled, *port_, communicator_of(lmp_), state_to_read_);
  port_->check_box(coupled.fluid.faces);
  Vec3 low;
  const lbm::Decomposition parts = decomposition(low);
  coupled.substeps = choose_substeps();
  if (const std::string note = unused_words_note(settings_); !note.empty()) tell(lmp_, note);
  simulation_ = std::make_unique<CoupledSimulation>(coupled, parts, low, *port_);
  require_walls(lmp_, settings_.walls.open);
  simulation_->set_effects(effects);
  walls_.follow(scene(), settings_.walls, state_to_read_);
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
         "`run` and `dem_timestep`"});
  const bool moves = port_->anything_moves();
  if (moves) require_grains_of(lmp_, state_to_read_);
  if (moves || (port_->loads_restored() && grains_are_of(lmp_, state_to_read_)))
    simulation_->continue_loads();
  load_pore_coefficients(state_to_read_, *simulation_);
  load_method(state_to_read_, *simulation_);
  output_.set_references(load_references(state_to_read_, communicator_of(lmp_)));
  continued_at_ = simulation_->time_si();
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

/// The script's time step is the largest that the contacts allow; the fluid's step is divided into as many
/// equal ones as it needs, or as `substeps` says.
int LbmCommand::choose_substeps() {
  const double fluid_step = lbm::Units(settings_.coupled.units).time_step(), largest = port_->time_step();
  constexpr double most = 1e6;
  if (!(largest > 0) || fluid_step / largest > most)
    throw_user_error(
        {"lbm run", "timestep", fmt::format("{:g} s", largest),
         fmt::format("be > 0 and at least a millionth of the fluid's step, {:.6g} s", fluid_step),
         "`dem_timestep rayleigh 0.15` sets what the contacts allow"});
  const int needed = std::max(1, static_cast<int>(std::ceil(fluid_step / largest * (1 - 1e-9))));
  const int asked = settings_.coupled.substeps;
  if (asked > 0 && asked < needed)
    throw_user_error({"lbm couple", "substeps", fmt::format("{}", asked),
                      fmt::format("be at least {}: a fluid step is {:.6g} s, the DEM's `timestep` {:.6g} s",
                                  needed, fluid_step, largest),
                      "use `substeps auto`"});
  const int substeps = asked > 0 ? asked : needed;
  port_->set_time_step(fluid_step / substeps);
  return substeps;
}

void LbmCommand::accuracy(ArgumentReader& reader) {
  const AccuracyRequest request = read_accuracy(reader);
  require_box(lmp_, reader.who());
  if (settings_.coupled.averaged)
    throw_user_error({reader.who(), "method", "averaged", "be resolved: its errors are those of a drag law",
                      "write `lbm lattice` with a spacing of about three mean diameters"});
  const bool made_port = port_ == nullptr;
  if (made_port) port_ = std::make_unique<LiggghtsPort>(lmp_);
  set_accuracy(lmp_, request, *port_, settings_);
  if (!made_port) return;
  port_->withdraw();
  port_.reset();
}

void LbmCommand::plan(ArgumentReader& reader) {
  require_lattice(reader.who());
  const double time = reader.positive("time");
  if (!reader.done()) reader.unknown(reader.word("end of line"), "nothing more");
  if (port_ == nullptr) port_ = std::make_unique<LiggghtsPort>(lmp_);
  CoupledSettings coupled = settings_now();
  coupled.effects = RunEffects().start(coupled, *port_, communicator_of(lmp_), "");
  port_->check_box(coupled.fluid.faces);
  Vec3 low;
  const lbm::Decomposition parts = decomposition(low);
  const double time_step = port_->time_step();
  coupled.substeps = choose_substeps();
  double looks = 1. / LbmRun::kCheckEvery;
  for (const MonitorRequest& monitor : settings_.monitors)
    looks = std::max(looks, std::min(1., lbm::Units(coupled.units).time_step() / monitor.every));
  plan_run(lmp_, coupled, parts, low, *port_, time, looks);
  // As if there had been no plan.
  port_->set_time_step(time_step);
  if (simulation_ != nullptr) return;
  port_->withdraw();
  port_.reset();
}

void LbmCommand::run(ArgumentReader& reader) {
  require_lattice(reader.who());
  RunRequest request;
  const bool until = reader.accept("until");
  request.time = reader.positive("time");
  if (reader.accept("until")) {
    if (!reader.accept("steady")) reader.unknown(reader.word("condition"), "steady");
    request.steady = reader.positive("share");
    if (*request.steady >= 1)
      throw_user_error({reader.who(), "until steady", fmt::format("{:g}", *request.steady), "be below 1",
                        "it is a share of the flow"});
    if (reader.accept("window")) request.window = reader.positive("window");
  }
  if (!reader.done()) reader.unknown(reader.word("end of line"), "nothing more");
  if (port_ == nullptr) port_ = std::make_unique<LiggghtsPort>(lmp_);
  if (settings_.coupled.effects.buoyancy != Switch::off && !settings_.gravity.is_zero())
    refuse_double_buoyancy(lmp_);
  require_no_sets_of_grains(lmp_, reader.who());
  if (settings_.wall_limit.given() && !settings_.checkpoint)
    throw_user_error({"lbm stop", "after", settings_.wall_limit.text(), "have a place for the state",
                      "write `lbm restart write FILE every T` before `lbm run`"});
  if (simulation_ == nullptr) {
    build();
  } else {
    port_->check_unchanged();
    const CoupledSettings now = settings_now();
    port_->check_box(now.fluid.faces);
    simulation_->set_substeps(choose_substeps());
    simulation_->set_faces(now.fluid.faces);
    simulation_->set_gravity(now.gravity);
    (void)walls_.follow(scene(), settings_.walls, "");
  }
  if (until) {
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
  for (const std::string& line : effects_.begin(scene(), walls_.planes()))
    tell(lmp_, "lbm run: " + line + "\n");
  LbmRun(scene(), settings_, output_, effects_).run(request, continued_at_);
}

}  // namespace suffuse::coupling
