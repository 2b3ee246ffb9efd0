#include "lbm_words_of_coupling.h"

#include <algorithm>

#include "lbm_word_values.h"

namespace suffuse::coupling {

namespace {

const Options<Switch> kSwitch{{"on", Switch::on}, {"off", Switch::off}, {"auto", Switch::automatic}};

std::string word_of(Switch value) {
  for (const auto& [word, meaning] : kSwitch)
    if (meaning == value) return word;
  return "";
}

D::W yes_no(const std::string& name, bool LbmRequest::*place, const std::string& meaning) {
  return D::choice<bool>(
      name, kYesNo, [place](LbmRequest& r) -> bool& { return r.*place; }, meaning);
}

D::W fraction_word() {
  static const Options<FractionMethod> methods{{"exact", FractionMethod::exact},
                                               {"linear", FractionMethod::linear},
                                               {"subcells", FractionMethod::subcells}};
  D::W word = D::choice(
      "fraction", methods, [](LbmRequest& r) -> FractionMethod& { return r.solids.fraction; },
      "which part of a cell a sphere covers; N sub-cells an edge");
  word.facts.value += " [N]";
  word.read = [inner = word.read](ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, LbmRequest& r) {
    inner(reader, lmp, r);
    if (r.solids.fraction != FractionMethod::subcells || !reader.next_is_number()) return;
    const auto n = reader.positive_integer("subcells");
    if (n > 32)
      throw_user_error(
          {reader.who(), "subcells", fmt::format("{}", n), "be at most 32", "5 is the thesis's"});
    r.solids.subcells = static_cast<int>(n);
  };
  return D::kept(word, [](const SettingsOfState& s) {
    const SolidSettings& solids = s.settings.solids;
    for (const auto& [name, method] : methods)
      if (method == solids.fraction)
        return method == FractionMethod::subcells ? fmt::format("{} {}", name, solids.subcells) : name;
    return std::string();
  });
}

std::string coefficient_of(const SettingsOfState& state) {
  const SolidSettings& solids = state.settings.solids;
  if (solids.cells.weighting != lbm::SolidWeighting::viscosity_independent) return "none";
  return solids.automatic_coefficient ? "auto" : digits(solids.cells.coefficient);
}

/// Only one weighting has coefficients.
void settle_coefficient(ArgumentReader& reader, const LbmRequest& before, LbmRequest& r, const Given& given) {
  const auto has_one = [](const LbmRequest& request) {
    return request.solids.cells.weighting == lbm::SolidWeighting::viscosity_independent;
  };
  const bool coefficient_given = given.count("coefficient") != 0;
  if (!has_one(r)) {
    if (coefficient_given)
      throw_user_error({reader.who(), "coefficient", "given", "go with weighting viscosity_independent",
                        "drop it, or change the weighting"});
    r.solids.automatic_coefficient = false;
  } else if (!coefficient_given && !has_one(before)) {
    r.solids.automatic_coefficient = true;
  }
}

Line solid_line() {
  static const Options<lbm::SolidWeighting> weightings{
      {"fraction", lbm::SolidWeighting::fraction},
      {"noble_torczynski", lbm::SolidWeighting::noble_torczynski},
      {"viscosity_independent", lbm::SolidWeighting::viscosity_independent}};
  const NumberWord coefficient{
      "coefficient", "K", "", between(1e-3, kSafeCoefficient),
      "of the viscosity-independent weighting: `auto` calibrated by the diameter and by "
      "the pore at each cell, or the same everywhere"};
  const NumberWord remap{"remap", "SHIFT", "cells", positive_up_to(0.1),
                         "a grain that moved less is not mapped again"};
  Line line{.name = "solid", .meaning = "how grains act on the water of their cells"};
  line.only_before_run = line.only_resolved = true;
  line.words = {
      D::kept(D::choice(
                  "operator", lbm::solid_words(),
                  [](LbmRequest& r) -> lbm::SolidOperator& { return r.solids.cells.solid_operator; },
                  "how partly covered cells treat the water"),
              [](const SettingsOfState& s) { return name_of(s.settings.solids.cells.solid_operator); }),
      D::kept(D::choice(
                  "weighting", weightings,
                  [](LbmRequest& r) -> lbm::SolidWeighting& { return r.solids.cells.weighting; },
                  "B of the solid fraction (thesis eq 3.34 is `noble_torczynski`)"),
              [](const SettingsOfState& s) { return name_of(s.settings.solids.cells.weighting); }),
      D::kept(D::or_auto(
                  D::number(coefficient,
                            [](LbmRequest& r) -> double& {
                              r.solids.automatic_coefficient = false;
                              return r.solids.cells.coefficient;
                            }),
                  [](LbmRequest& r) { r.solids.automatic_coefficient = true; },
                  [](const LbmRequest& r) { return r.solids.automatic_coefficient; }),
              coefficient_of),
      fraction_word(), D::number(remap, [](LbmRequest& r) -> double& { return r.solids.remap_distance; })};
  line.begin = [](ArgumentReader& reader, LbmRequest&) { (void)reader.accept("psm"); };
  line.finish = settle_coefficient;
  return line;
}

void read_open_walls(ArgumentReader& reader, WallSettings& walls) {
  do {
    const std::string id = reader.word("ID of a fix wall/gran or of its mesh");
    if (std::find(walls.open.begin(), walls.open.end(), id) != walls.open.end())
      throw_user_error({reader.who(), "open " + id, "given twice", "be given once", "drop one of them"});
    walls.open.push_back(id);
  } while (!reader.done());
}

void read_water_of_walls(ArgumentReader& reader, WallSettings& walls) {
  using Water = WallSettings::Water;
  walls.points.clear();
  walls.water =
      choose<Water>(reader, "water",
                    {{"grains", Water::with_grains}, {"all", Water::everywhere}, {"at", Water::at_points}});
  if (walls.water != Water::at_points) return;
  do {
    const double x = reader.number("x"), y = reader.number("y"), z = reader.number("z");
    walls.points.emplace_back(x, y, z);
  } while (!reader.done());
}

Line walls_line() {
  Line line{.name = "walls", .meaning = "which walls of the script are solid for the water"};
  line.only_before_run = line.at_least_one = line.one_of = true;
  line.words = {
      {{"open", "ID ...", "", "", "",
        "these walls (a fix, or one of its meshes) let water pass: sieves, gates, pistons with holes"},
       [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, LbmRequest& r) { read_open_walls(reader, r.walls); }},
      {{"water", "grains|all|at X Y Z ...", "m", "", "grains",
        "water in the spaces between walls that a grain lies in (all of them without grains), on all "
        "sides of all walls, or in those with these points"},
       [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, LbmRequest& r) {
         read_water_of_walls(reader, r.walls);
       }}};
  return line;
}

D::W effect_word(const std::string& name, Switch EffectSettings::*place, const std::string& meaning) {
  return D::kept(D::choice(
                     name, kSwitch, [place](LbmRequest& r) -> Switch& { return r.effects.*place; }, meaning),
                 [place](const SettingsOfState& s) { return word_of(s.settings.effects.*place); });
}

D::W turbulence_word() {
  D::W word =
      effect_word("turbulence", &EffectSettings::turbulence,
                  fmt::format("Smagorinsky's eddy viscosity, C = {:g}", EffectSettings{}.smagorinsky));
  word.facts.value += " [C]";
  word.read = [inner = word.read](ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, LbmRequest& r) {
    inner(reader, lmp, r);
    if (reader.next_is_number()) r.effects.smagorinsky = reader.positive("Smagorinsky constant");
  };
  return D::kept(word, [](const SettingsOfState& s) {
    const EffectSettings& effects = s.settings.effects;
    const std::string asked = word_of(effects.turbulence);
    return effects.turbulence == Switch::off ? asked : asked + " " + digits(effects.smagorinsky);
  });
}

Line effect_line() {
  Line line{.name = "effect", .meaning = "what a scene pays for"};
  line.only_before_run = true;
  line.words = {turbulence_word(),
                effect_word("comoving", &EffectSettings::comoving, "`trt_comoving` in place of `trt`"),
                effect_word("lubrication", &EffectSettings::lubrication,
                            "forces of films that the lattice does not resolve"),
                effect_word("buoyancy", &EffectSettings::buoyancy, "weight of displaced water on grains"),
                effect_word("rotation", &EffectSettings::rotation, "torque of the water on grains")};
  line.finish = [](ArgumentReader&, const LbmRequest&, LbmRequest& r, const Given& given) {
    r.comoving_given = r.comoving_given || given.count("comoving") != 0;
  };
  return line;
}

D::W substeps_word() {
  return {{"substeps", "auto|N", "", "1 to 1000000", "auto",
           "DEM steps in a fluid step: as many as the script's `timestep` needs, or N"},
          [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, LbmRequest& r) {
            constexpr std::int64_t most = 1000000;
            const std::int64_t n = reader.accept("auto") ? 0 : reader.positive_integer("substeps");
            if (n > most)
              throw_user_error({reader.who(), "substeps", fmt::format("{}", n),
                                fmt::format("be at most {}", most),
                                "`auto` takes as many as the script's `timestep` needs"});
            r.substeps = static_cast<int>(n);
          }};
}

Line couple_line() {
  const NumberWord virtual_mass{
      "virtual_mass", "CV", "", between(0, 100),
      "how much of the water's answer to a grain's motion is foreseen, in displaced water; a "
      "sphere's is 0.5"};
  const NumberWord max_mach{"max_mach", "MA", "", positive_up_to(1), "the run ends above"};
  Line line{.name = "couple", .meaning = "how water and grains meet"};
  line.words = {
      substeps_word(),
      yes_no("average_force", &LbmRequest::average_force, "the mean load of the last two fluid steps"),
      D::or_auto(
          D::number(virtual_mass, [](LbmRequest& r) -> std::optional<double>& { return r.virtual_mass; }),
          [](LbmRequest& r) { r.virtual_mass.reset(); }, [](const LbmRequest& r) { return !r.virtual_mass; }),
      D::number(max_mach, [](LbmRequest& r) -> double& { return r.largest_mach; })};
  return line;
}

D::W limit_word(const char* name, double GuardLimits::*place, const char* unit, const char* meaning) {
  return D::number({name, "LIMIT", unit, positive_up_to(1e300), meaning},
                   [place](LbmRequest& r) -> double& { return r.guards.*place; });
}

Line guard_line() {
  Line line{.name = "guard", .meaning = "how far a run may go before it is ended"};
  line.words = {
      limit_word("density", &GuardLimits::density, "", "departure of a cell's density from rest, as a share"),
      limit_word("motion", &GuardLimits::motion, "cells", "that a grain passes in a fluid step"),
      limit_word("overlap", &GuardLimits::overlap, "",
                 "share of the grains' volume that lies in other grains"),
      limit_word("mass", &GuardLimits::mass, "",
                 "change of the water's mass where no face lets any in, as a share"),
      limit_word("momentum", &GuardLimits::momentum, "",
                 "what is missing of it along axes without walls and faces, as a share"),
      D::choice<bool>(
          "lost", {{"warn", false}, {"stop", true}},
          [](LbmRequest& r) -> bool& { return r.guards.stop_if_lost; },
          "what a grain that leaves the box does to the run")};
  return line;
}

}  // namespace

std::vector<Command<LbmRequest>> commands_of_coupling() {
  return {solid_line(), walls_line(), effect_line(), couple_line(), guard_line()};
}

}  // namespace suffuse::coupling
