#include "suffuse/coupling/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace suffuse::coupling {

namespace {

EffectChoice turbulence(Switch asked, const SceneFacts& facts, const lbm::Units& units) {
  const double reynolds = facts.fastest_flow * units.spacing() / units.viscosity_si();
  if (asked != Switch::automatic) return {"turbulence", asked == Switch::on, "as asked for"};
  if (facts.fastest_flow <= 0)
    return {"turbulence", false, "no velocity is given with the lattice or a face"};
  return {"turbulence", reynolds > kLargestGridReynolds,
          fmt::format("u dx/nu = {:.3g} at {:.3g} m/s, limit {:g}", reynolds, facts.fastest_flow,
                      kLargestGridReynolds)};
}

EffectChoice lubrication(Switch asked, const SceneFacts& facts, const lbm::Units& units) {
  if (asked != Switch::automatic) return {"lubrication", asked == Switch::on, "as asked for"};
  if (!facts.grains_move) return {"lubrication", false, "nothing moves the grains"};
  if (facts.packing > kTouchingPacking)
    return {"lubrication", false,
            fmt::format("grains rest on each other (solid fraction {:.2f})", facts.packing)};
  // Without a given velocity the speed of a fall through one's own diameter is an upper bound.
  const double d = 2 * facts.largest_radius, heavier = std::abs(facts.largest_density / units.density() - 1);
  const double speed = std::max(facts.fastest_flow, std::sqrt(heavier * facts.gravity * d));
  const double stokes = facts.largest_density / units.density() * d * speed / (9 * units.viscosity_si());
  return {"lubrication", stokes < kDryStokes,
          fmt::format("Stokes number up to {:.3g}, as if dry from {:g} on", stokes, kDryStokes)};
}

EffectChoice buoyancy(Switch asked, const SceneFacts& facts) {
  if (facts.gravity == 0) return {"buoyancy", false, "no `lbm force gravity`"};
  return {"buoyancy", asked != Switch::off, asked == Switch::off ? "as asked for" : "the fluid has weight"};
}

EffectChoice rotation(Switch asked, const SceneFacts& facts) {
  if (!facts.grains_move) return {"rotation", false, "nothing moves the grains"};
  return {"rotation", asked != Switch::off, asked == Switch::off ? "as asked for" : "grains turn"};
}

Switch switched(bool on) {
  return on ? Switch::on : Switch::off;
}

}  // namespace

std::vector<EffectChoice> choose_effects(EffectSettings& effects, const SceneFacts& facts,
                                         const lbm::Units& units) {
  std::vector<EffectChoice> choices{turbulence(effects.turbulence, facts, units),
                                    lubrication(effects.lubrication, facts, units),
                                    buoyancy(effects.buoyancy, facts), rotation(effects.rotation, facts)};
  effects.turbulence = switched(choices[0].on);
  effects.lubrication = switched(choices[1].on);
  effects.buoyancy = switched(choices[2].on);
  effects.rotation = switched(choices[3].on);
  return choices;
}

double pressure_diffusion_time(double height, double porosity, double diameter, const lbm::Units& units) {
  const double solid = 1 - porosity;
  const double permeability = diameter * diameter * std::pow(porosity, 3) / (180 * solid * solid);
  const double sound_squared = std::pow(units.velocity_to_si(1.), 2) / 3;
  return height * height * units.viscosity_si() /
         (std::numbers::pi * std::numbers::pi * permeability * sound_squared);
}

}  // namespace suffuse::coupling
