#include "run_effects.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "../liggghts/instance.h"

namespace suffuse::coupling {

namespace {

/// Before the name of an effect among the monitors' references of a saved state.
constexpr std::string_view kMark = "effect: ";

/// Largest of this value on any rank.
double largest_of_ranks(double value, MPI_Comm communicator) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return value;
}

double largest_virtual_mass_number(const CoupledSettings& settings, const LiggghtsPort& port) {
  if (settings.averaged) return 0;  // has inertia of its own
  const VirtualMassRule rule = virtual_mass_rule(settings, lbm::Units(settings.units));
  double largest = 0;
  for (const LiggghtsPort::OwnedGrain& grain : port.owned())
    largest = std::max(largest, virtual_mass_number(rule, grain.radius, grain.mass));
  return largest;
}

}  // namespace

double fastest_wet_grain(const LiggghtsPort& port, const CoupledSimulation& simulation) {
  double fastest = 0;
  for (const LiggghtsPort::OwnedGrain& grain : port.owned())
    if (simulation.holds(grain.position)) fastest = std::max(fastest, grain.speed);
  return largest_of_ranks(fastest, simulation.fluid().decomposition().communicator());
}

double given_speed(const lbm::UnitsRequest& request, const lbm::FaceConditions& faces) {
  const lbm::Units units(request);
  double fastest = request.largest_velocity.value_or(0);
  for (const lbm::FaceCondition& face : faces)
    if (face.kind == lbm::FaceKind::velocity)
      fastest = std::max(fastest, units.velocity_to_si(face.velocity).norm());
  return fastest;
}

EffectFacts facts_of_grains(const CoupledSettings& settings, const LiggghtsPort& port,
                            LAMMPS_NS::LAMMPS* lmp) {
  const LiggghtsPort::Summary grains = port.summary();
  EffectFacts facts;
  facts.given_speed = given_speed(settings.units, settings.fluid.faces);
  facts.grain_speed = grains.speed;
  facts.largest_radius = grains.largest_radius;
  facts.largest_density = grains.largest_density;
  facts.packing = grains.packing;
  facts.gravity = settings.gravity.norm();
  facts.grains_move = grains.grains > 0 && port.anything_moves();
  facts.virtual_mass = largest_of_ranks(largest_virtual_mass_number(settings, port), communicator_of(lmp));
  facts.films_of_script = FilmForces::of_script(lmp);
  return facts;
}

EffectFacts RunEffects::facts_now(const Scene& scene, double water_speed) const {
  CoupledSettings now = scene.simulation.settings();
  now.fluid.faces = scene.simulation.fluid().settings().faces;
  EffectFacts facts = facts_of_grains(now, scene.port, scene.lmp);
  facts.water_speed = water_speed;
  facts.grain_speed = fastest_wet_grain(scene.port, scene.simulation);
  return facts;
}

EffectSettings RunEffects::start(const CoupledSettings& settings, const LiggghtsPort& port,
                                 LAMMPS_NS::LAMMPS* lmp, const std::string& state) {
  switches_.emplace(settings, lbm::Units(settings.units));
  if (!state.empty()) {
    std::map<std::string, std::vector<double>> record;
    for (const auto& [name, values] : load_references(state, communicator_of(lmp)))
      if (name.starts_with(kMark)) record[name.substr(kMark.size())] = values;
    switches_->restore(record, "lbm restart read " + state);
    restored_ = !record.empty();
  }
  // What follows from the script alone, and the rest where no state has it.
  (void)switches_->begin(facts_of_grains(settings, port, lmp), 0);
  return switches_->settings();
}

std::vector<std::string> RunEffects::begin(const Scene& scene, const FilmForces::Water& water) {
  CoupledSimulation& simulation = scene.simulation;
  water_ = water;
  if (restored_) looked_at_ = simulation.fluid().steps();  // the run that saved it has looked
  restored_ = false;
  const double speed = simulation.units().velocity_to_si(simulation.extremes().largest_speed);
  std::vector<std::string> lines = switches_->begin(facts_now(scene, speed), simulation.time_si());
  simulation.set_effects(switches_->settings());
  films_.follow(scene, water_);
  return lines;
}

std::vector<std::string> RunEffects::check(const Scene& scene, const lbm::FluidExtremes& extremes) {
  CoupledSimulation& simulation = scene.simulation;
  const long step = simulation.fluid().steps();
  if (step % kEffectsEvery != 0 || step == looked_at_) return {};
  looked_at_ = step;
  const double water = simulation.units().velocity_to_si(extremes.largest_speed);
  std::vector<std::string> lines = switches_->check(facts_now(scene, water), simulation.time_si());
  if (lines.empty()) return lines;
  simulation.set_effects(switches_->settings());
  if (films_.follow(scene, water_)) {
    simulation.refresh_loads();  // the grains' memory travels with them
    scene.port.set_up_with_new_fixes();
    (void)simulation.map_anew();
  }
  return lines;
}

void RunEffects::add_to(MonitorReferences& references) const {
  for (const auto& [name, values] : switches_->record()) references[std::string(kMark) + name] = values;
}

}  // namespace suffuse::coupling
