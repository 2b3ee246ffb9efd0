#include "effect_report.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "suffuse/common/collective_text.h"
#include "suffuse/coupling/collision_price.h"

namespace suffuse::coupling {

namespace {

/// Cells of the fluids that tell what a collision costs: more than the caches hold, if the run has them.
constexpr double kTrialCells = 4e5;

lbm::Index3 trial_cells(const lbm::Index3& run) {
  lbm::Index3 cells = run;
  const double most = kTrialCells / (static_cast<double>(cells[0]) * cells[1]);
  cells[2] = std::max(2, std::min(cells[2], static_cast<int>(most)));
  return cells;
}

double mean_of_ranks(double value, MPI_Comm communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, communicator);
  return value / ranks;
}

/// Share of the fluid's time that this collision's eddy viscosity, or its frame, takes.
double price_of(const std::string& name, const CoupledSimulation& simulation) {
  lbm::CollisionSettings with = simulation.fluid().settings().collision;
  if (name == "comoving") with.collision_operator = lbm::CollisionOperator::trt_comoving;
  if (name == "turbulence") with.smagorinsky = simulation.effects().smagorinsky;
  lbm::CollisionSettings without = with;
  if (name == "comoving") without.collision_operator = lbm::CollisionOperator::trt;
  if (name == "turbulence") without.smagorinsky = 0;
  const lbm::Decomposition& parts = simulation.fluid().decomposition();
  const double mine =
      collision_price(simulation.fluid().settings(), with, without, trial_cells(parts.local_box().extents()));
  return mean_of_ranks(mine, parts.communicator());
}

const char* asked_word(Switch asked) {
  if (asked == Switch::automatic) return "auto";
  return asked == Switch::on ? "on" : "off";
}

EffectReport::Row part(const char* name, const char* what, double share) {
  EffectReport::Row row;
  row.state.name = name;
  row.state.on = share > 0;
  row.state.reason = what;
  row.time_share = share;
  return row;
}

}  // namespace

void EffectReport::begin(LAMMPS_NS::LAMMPS* lmp, const RunEffects& effects,
                         const CoupledSimulation& simulation) {
  first_ = counted_ = simulation.fluid().steps();
  rested_before_ = simulation.rested_steps();
  steps_on_.assign(effects.states().size(), 0);
  films_before_ = effects.film_seconds(lmp);
}

void EffectReport::count(const RunEffects& effects, long step) {
  for (std::size_t n = 0; n < steps_on_.size(); ++n)
    if (effects.states()[n].on) steps_on_[n] += step - counted_;
  counted_ = step;
}

std::vector<EffectReport::Row> EffectReport::rows(LAMMPS_NS::LAMMPS* lmp, const RunEffects& effects,
                                                  CoupledSimulation& simulation, double wall) const {
  const MPI_Comm communicator = simulation.fluid().decomposition().communicator();
  const CoupledTimes& times = simulation.times();
  std::array<double, 5> seconds{times.fluid, times.mapping + times.exchange, times.grains, times.output,
                                effects.film_seconds(lmp) - films_before_};
  MPI_Allreduce(MPI_IN_PLACE, seconds.data(), 5, MPI_DOUBLE, MPI_MAX, communicator);
  const double steps = static_cast<double>(std::max(1L, counted_ - first_));
  double fluid = seconds[0] / wall;
  const double films = seconds[4] / wall, grains = std::max(0., seconds[2] / wall - films);
  std::vector<Row> all;
  for (std::size_t n = 0; n < effects.states().size(); ++n) {
    Row row;
    row.state = effects.states()[n];
    const std::string& name = row.state.name;
    row.steps_share = static_cast<double>(steps_on_[n]) / steps;
    if (name == "motion") {
      row.time_share = grains;
    } else if (name == "lubrication") {
      row.time_share = films;
    } else if (name == "turbulence" || name == "comoving") {
      row.time_share =
          steps_on_[n] == 0 ? 0 : price_of(name, simulation) * *row.steps_share * seconds[0] / wall;
      fluid -= *row.time_share;
    } else if (steps_on_[n] == 0) {
      row.time_share = 0;
    } else {
      row.within = "solid coupling";
    }
    all.push_back(row);
  }
  Row water = part("fluid", simulation.method() != nullptr ? "averaged" : "lattice", std::max(0., fluid));
  water.steps_share = 1 - static_cast<double>(simulation.rested_steps() - rested_before_) / steps;
  water.state.on = *water.steps_share > 0;
  all.push_back(water);
  all.push_back(part("solid coupling", "mapping and forces on grains", seconds[1] / wall));
  all.push_back(part("outputs", "monitors, outputs, saved states and checks", seconds[3] / wall));
  return all;
}

std::string effect_report_file(const LbmRequest& settings) {
  std::string beside;
  if (!settings.monitors.empty())
    beside = settings.monitors.front().file;
  else if (!settings.outputs.empty())
    beside = settings.outputs.front().file;
  if (beside.empty()) return "";
  return (std::filesystem::path(beside).parent_path() / "effects.json").string();
}

void write_effect_report(const std::string& file, const std::vector<EffectReport::Row>& rows,
                         const CoupledSimulation& simulation, double wall, long steps,
                         MPI_Comm communicator) {
  using nlohmann::ordered_json;
  ordered_json list = ordered_json::array();
  for (const EffectReport::Row& row : rows) {
    const EffectState& state = row.state;
    ordered_json one{{"name", state.name}, {"on", state.on}};
    if (row.steps_share) one["asked"] = asked_word(state.asked);
    const bool numbered = !state.number.name.empty();
    if (numbered) {
      one["number"] = state.number.name;
      one["value"] = state.number.value;  // not a number becomes null
      one["limit"] = state.number.bounds.limit;
      one["release"] = state.number.bounds.release;
      one["on_above"] = state.number.on_when_above;
    }
    one["source"] = numbered ? state.number.source : state.reason;
    if (row.steps_share) {
      one["changes"] = state.changes;
      one["changed_at_s"] = state.changed_at;
      one["share_of_steps"] = *row.steps_share;
    }
    one["share_of_time"] = row.time_share ? ordered_json(*row.time_share) : ordered_json(nullptr);
    if (!row.within.empty()) one["within"] = row.within;
    list.push_back(one);
  }
  const ordered_json report{
      {"time_s", simulation.time_si()}, {"steps", steps}, {"wall_s", wall}, {"effects", list}};
  write_text(file, "lbm run", report.dump(1) + "\n", communicator);
}

}  // namespace suffuse::coupling
