#include "suffuse/coupling/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "suffuse/common/error.h"
#include "suffuse/coupling/virtual_mass.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kAsked = "as asked for";
constexpr const char* kNotAveraged = "the averaged flow has none";
constexpr const char* kHeld = "nothing moves the grains";

struct Speed {
  double value = 0;
  std::string source;
};

Speed fastest_of(const EffectFacts& facts) {
  Speed speed{facts.given_speed,
              facts.given_speed > 0 ? "given with the lattice or a face" : "nothing moves"};
  if (facts.water_speed > speed.value) speed = {facts.water_speed, "fastest water"};
  if (facts.grain_speed > speed.value) speed = {facts.grain_speed, "fastest grain"};
  return speed;
}

/// Effects that the averaged flow has not.
bool is_resolved_only(const std::string& name) {
  return name == "turbulence" || name == "comoving" || name == "lubrication" || name == "rotation";
}

/// Of a sphere that falls through its own diameter: an upper bound of speeds at which grains meet.
double speed_of_fall(const EffectFacts& facts, const lbm::Units& units) {
  const double heavier = std::abs(facts.largest_density / units.density() - 1);
  return std::sqrt(heavier * facts.gravity * 2 * facts.largest_radius);
}

}  // namespace

double largest_comoving_speed(double relaxation_time) {
  if (relaxation_time < 0.51) return 0.04;
  return relaxation_time < 0.52 ? 0.1 : 0.15;
}

EffectSwitches::EffectSwitches(const CoupledSettings& asked, const lbm::Units& units)
    : units_(units),
      averaged_(asked.averaged.has_value()),
      operator_(asked.fluid.collision.collision_operator),
      virtual_mass_(asked.virtual_mass),
      smagorinsky_(asked.effects.smagorinsky) {
  const EffectSettings& effects = asked.effects;
  const std::pair<const char*, Switch> all[] = {
      {"motion", Switch::automatic},        {"rotation", effects.rotation},
      {"buoyancy", effects.buoyancy},       {"added mass", Switch::automatic},
      {"lubrication", effects.lubrication}, {"turbulence", effects.turbulence},
      {"comoving", effects.comoving}};
  for (const auto& [name, asked_for] : all) {
    EffectState state;
    state.name = name;
    state.asked = asked_for;
    states_.push_back(state);
    if (averaged_ && is_resolved_only(name) && asked_for == Switch::on && state.name != "rotation")
      throw_user_error({"lbm effect", name, "on", "be off or auto with `lbm method averaged`",
                        "only the resolved flow has it"});
  }
  if (effects.comoving == Switch::on && operator_ != lbm::CollisionOperator::trt &&
      operator_ != lbm::CollisionOperator::trt_comoving)
    throw_user_error({"lbm effect", "comoving", "on",
                      fmt::format("be off or auto with `lbm collision {}`", name_of(operator_)),
                      "it is `trt` about the water's own velocity: drop the line `lbm collision`"});
}

EffectState& EffectSwitches::at(const std::string& name) {
  for (EffectState& state : states_)
    if (state.name == name) return state;
  throw std::logic_error("EffectSwitches: no effect " + name);
}

const EffectState& EffectSwitches::state(const std::string& name) const {
  return const_cast<EffectSwitches*>(this)->at(name);
}

EffectSettings EffectSwitches::settings() const {
  const auto switched = [this](const char* name) { return state(name).on ? Switch::on : Switch::off; };
  EffectSettings effects;
  effects.smagorinsky = smagorinsky_;
  effects.motion = switched("motion");
  effects.turbulence = switched("turbulence");
  effects.comoving = switched("comoving");
  effects.lubrication = switched("lubrication");
  // Without gravity there is none of it: where gravity follows a variable, it comes and goes with it.
  effects.buoyancy = state("buoyancy").asked == Switch::off ? Switch::off : Switch::on;
  effects.rotation = switched("rotation");
  return effects;
}

void EffectSwitches::decide_scene(const EffectFacts& facts) {
  at("motion").decide(facts.grains_move, facts.grains_move ? "a fix moves grains" : kHeld);
  EffectState& buoyancy = at("buoyancy");
  if (buoyancy.asked == Switch::off)
    buoyancy.decide(false, kAsked);
  else
    buoyancy.decide(facts.gravity > 0, facts.gravity > 0 ? "the fluid has weight" : "no `lbm force gravity`");
  EffectState& rotation = at("rotation");
  if (averaged_)
    rotation.decide(false, kNotAveraged);
  else if (!facts.grains_move)
    rotation.decide(false, kHeld);
  else
    rotation.decide(rotation.asked != Switch::off, rotation.asked == Switch::off ? kAsked : "grains turn");
  EffectState& added = at("added mass");
  if (virtual_mass_)
    added.decide(*virtual_mass_ > 0,
                 fmt::format("{:g} times the displaced fluid's, as asked for", *virtual_mass_));
  else if (!facts.grains_move)
    added.decide(false, kHeld);
  else if (averaged_)
    added.decide(true, "for grains that answer the water faster than a step");
  else
    added.decide({{"C m_f/m",
                   facts.virtual_mass,
                   {kSafeResponse, kSafeResponse},
                   "largest of the grains",
                   true,
                   false}});
}

void EffectSwitches::turbulence(const EffectFacts& facts) {
  EffectState& state = at("turbulence");
  const Speed fastest = fastest_of(facts);
  if (state.asked != Switch::automatic)
    state.decide(state.asked == Switch::on, kAsked);
  else
    state.decide({{"u dx/nu", fastest.value * units_.spacing() / units_.viscosity_si(), kGridReynolds,
                   fastest.source, true, false}});
}

void EffectSwitches::comoving(const EffectFacts& facts) {
  EffectState& state = at("comoving");
  if (operator_ == lbm::CollisionOperator::trt_comoving)
    return state.decide(true, "`lbm collision trt_comoving`");
  if (operator_ != lbm::CollisionOperator::trt)
    return state.decide(false, fmt::format("`lbm collision {}`", name_of(operator_)));
  if (state.asked != Switch::automatic) return state.decide(state.asked == Switch::on, kAsked);
  if (!facts.grains_move) return state.decide(false, kHeld);
  const Speed fastest = fastest_of(facts);
  const double most = largest_comoving_speed(units_.relaxation_time());
  state.decide({{"V dx/nu", facts.grain_speed * units_.spacing() / units_.viscosity_si(), kFastGrains,
                 "fastest grain", true, false},
                {"cells a step",
                 units_.velocity_to_lattice(fastest.value),
                 {most, 0.8 * most},
                 fastest.source + ", stability",
                 false,
                 false}});
}

void EffectSwitches::lubrication(const EffectFacts& facts) {
  EffectState& state = at("lubrication");
  films_of_script_ = facts.films_of_script;
  if (!facts.films_of_script.empty())
    return state.decide(true, fmt::format("`fix {} lubrication` of the script", facts.films_of_script));
  if (averaged_) return state.decide(false, kNotAveraged);
  if (state.asked != Switch::automatic) return state.decide(state.asked == Switch::on, kAsked);
  if (!facts.grains_move) return state.decide(false, kHeld);
  const double fall = speed_of_fall(facts, units_);
  Speed speed{std::max(facts.given_speed, fall),
              facts.given_speed > fall ? "given speed" : "fall of the largest grain"};
  if (facts.grain_speed > speed.value) speed = {facts.grain_speed, "fastest grain"};
  const double stokes = facts.largest_density / units_.density() * 2 * facts.largest_radius * speed.value /
                        (9 * units_.viscosity_si());
  state.decide(
      {{"Stokes number", stokes, kDryStokes, speed.source + ", as if dry", false, false},
       {"solid fraction", facts.packing, kTouchingPacking, "grains that rest on each other", false, false}});
}

void EffectSwitches::decide_flow(const EffectFacts& facts) {
  if (averaged_) {
    for (const char* name : {"turbulence", "comoving"}) at(name).decide(false, kNotAveraged);
  } else {
    turbulence(facts);
    comoving(facts);
  }
  lubrication(facts);
}

std::vector<std::string> EffectSwitches::changed_since(const std::vector<EffectState>& before, double time) {
  std::vector<std::string> lines;
  for (std::size_t n = 0; n < states_.size(); ++n) {
    EffectState& state = states_[n];
    if (state.on == before[n].on) continue;
    state.changed_at = time;
    ++state.changes;
    lines.push_back(
        fmt::format("{} {} from {:.6g} s: {}", state.name, state.on ? "on" : "off", time, state.text()));
  }
  return lines;
}

std::vector<std::string> EffectSwitches::begin(const EffectFacts& facts, double time) {
  const std::vector<EffectState> before = states_;
  const bool moved = state("motion").on;
  decide_scene(facts);
  if (!decided_ || moved != facts.grains_move)
    decide_flow(facts);
  else if (films_of_script_ != facts.films_of_script)
    lubrication(facts);
  if (decided_) return changed_since(before, time);
  decided_ = true;
  return {};
}

std::vector<std::string> EffectSwitches::check(const EffectFacts& facts, double time) {
  const std::vector<EffectState> before = states_;
  decide_scene(facts);
  decide_flow(facts);
  decided_ = true;
  return changed_since(before, time);
}

std::map<std::string, std::vector<double>> EffectSwitches::record() const {
  std::map<std::string, std::vector<double>> all;
  for (const EffectState& state : states_) all[state.name] = state.record();
  return all;
}

void EffectSwitches::restore(const std::map<std::string, std::vector<double>>& record,
                             const std::string& who) {
  for (EffectState& state : states_)
    if (const auto found = record.find(state.name); found != record.end()) state.restore(found->second, who);
  decided_ = !record.empty();
}

double pressure_diffusion_time(double height, double porosity, double diameter, const lbm::Units& units) {
  const double solid = 1 - porosity;
  const double permeability = diameter * diameter * std::pow(porosity, 3) / (180 * solid * solid);
  const double sound_squared = std::pow(units.velocity_to_si(1.), 2) / 3;
  return height * height * units.viscosity_si() /
         (std::numbers::pi * std::numbers::pi * permeability * sound_squared);
}

}  // namespace suffuse::coupling
