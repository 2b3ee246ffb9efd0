#include "lbm_words_of_water.h"

#include "lbm_word_values.h"
#include "suffuse/lbm/flow_words.h"

namespace suffuse::coupling {

namespace {

std::string word_of(bool value) {
  return value ? "yes" : "no";
}

/// The averaged flow has none, whatever the script says.
lbm::CollisionSettings collision_of(const SettingsOfState& state) {
  return state.settings.averaged ? lbm::CollisionSettings{} : state.settings.fluid.collision;
}

using Kept = std::optional<std::string>;

Options<DragLaw> drag_words() {
  Options<DragLaw> words;
  for (const DragLawEntry& entry : drag_laws()) words.emplace_back(entry.word, entry.law);
  return words;
}

AveragedSettings& averaged_of(ArgumentReader& reader, LbmRequest& request, const std::string& word) {
  if (!request.averaged)
    throw_user_error({reader.who(), word, "given", "go with averaged", "write `lbm method averaged ...`"});
  return *request.averaged;
}

Line method_line() {
  const AveragedSettings standard;
  Line line{.name = "method", .meaning = "what computes the water"};
  line.only_before_run = true;
  line.first = {{{"method", "resolved|averaged", "", "", "resolved",
                  "flow between the grains on a lattice, or averaged over cells larger than they are"},
                 [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, LbmRequest& r) {
                   r.averaged.reset();
                   if (choose<bool>(reader, "method", {{"resolved", false}, {"averaged", true}}))
                     r.averaged.emplace();
                 }}};
  line.words = {D::kept({{"drag", joined(drag_words(), "|"), "", "", name_of(standard.drag),
                          "closure of the averaged water's drag"},
                         [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, LbmRequest& r) {
                           averaged_of(reader, r, "drag").drag = choose(reader, "drag", drag_words());
                         }},
                        [](const SettingsOfState& s) {
                          return s.settings.averaged ? Kept(name_of(s.settings.averaged->drag)) : Kept();
                        }),
                D::kept({{"graded", joined(kYesNo, "|"), "", "", standard.graded ? "yes" : "no",
                          "drag of unequal spheres; `no`: that of equal ones of each grain's size"},
                         [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, LbmRequest& r) {
                           averaged_of(reader, r, "graded").graded = choose(reader, "graded", kYesNo);
                         }},
                        [](const SettingsOfState& s) {
                          return s.settings.averaged ? Kept(word_of(s.settings.averaged->graded)) : Kept();
                        })};
  line.begin = [](ArgumentReader& reader, LbmRequest& r) {
    if (r.lattice_given)
      throw_user_error({reader.who(), "line", "after lbm lattice", "come before it",
                        "what a spacing and a step may be depends on the method"});
  };
  line.finish = [](ArgumentReader&, const LbmRequest&, LbmRequest& r, const Given&) {
    r.units.only_cells_and_steps = r.averaged.has_value();
    r.method_given = true;
  };
  return line;
}

enum class Preset { standard, thesis, thesis_appendix };

/// Thesis sections 3.3 and 3.4, Appendix C: one relaxation time, SC1, 5 x 5 x 5 sub-cells, no lubrication.
/// The text weights cells after Noble and Torczynski (eq 3.34); the appendix includes LBDEMcoupling's headers
/// without the switch that turns this on, and B is the solid fraction then.
void take_preset(Preset preset, LbmRequest& request) {
  const LbmRequest standard;
  request.collision = standard.collision;
  request.solids = standard.solids;
  request.effects = standard.effects;
  request.comoving_given = false;
  request.average_force = standard.average_force;
  request.virtual_mass = standard.virtual_mass;
  if (preset == Preset::standard) return;
  request.collision.collision_operator = lbm::CollisionOperator::bgk;
  request.solids.cells.solid_operator = lbm::SolidOperator::sc1;
  request.solids.cells.weighting =
      preset == Preset::thesis ? lbm::SolidWeighting::noble_torczynski : lbm::SolidWeighting::fraction;
  request.solids.automatic_coefficient = false;
  request.solids.fraction = FractionMethod::subcells;
  request.solids.subcells = 5;
  request.effects.turbulence = Switch::off;
  request.effects.lubrication = Switch::off;
  request.virtual_mass = 0;
}

Line preset_line() {
  static const Options<Preset> presets{{"default", Preset::standard},
                                       {"thesis", Preset::thesis},
                                       {"thesis_appendix", Preset::thesis_appendix}};
  Line line{.name = "preset", .meaning = "resets collision, solid, effects and coupling"};
  line.only_before_run = line.only_resolved = true;
  line.first = {{{"preset", joined(presets, "|"), "", "", "default",
                  "the program's own, the thesis's text, or what its appendix compiles"},
                 [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, LbmRequest& r) {
                   take_preset(choose(reader, "preset", presets), r);
                 }}};
  return line;
}

Line fluid_line() {
  Line line{.name = "fluid", .meaning = "the water"};
  line.only_before_run = true;
  line.words = {
      D::kept(D::number(lbm::kDensityWord, [](LbmRequest& r) -> double& { return r.units.density; }),
              [](const SettingsOfState& s) { return digits(s.units.density()); }),
      D::kept(D::number(lbm::kViscosityWord, [](LbmRequest& r) -> double& { return r.units.viscosity; }),
              [](const SettingsOfState& s) { return digits(s.units.viscosity_si()); })};
  return line;
}

Line lattice_line() {
  using Number = std::optional<double>;
  Line line{.name = "lattice", .meaning = "cells and steps"};
  line.only_before_run = true;
  line.words = {
      D::kept(D::number(lbm::kSpacingWord, [](LbmRequest& r) -> Number& { return r.units.spacing; }),
              [](const SettingsOfState& s) { return digits(s.units.spacing()); }),
      D::kept(D::number(lbm::kRelaxationTimeWord,
                        [](LbmRequest& r) -> Number& { return r.units.relaxation_time; }),
              [](const SettingsOfState& s) { return digits(s.units.relaxation_time()); }),
      D::number(lbm::kTimestepWord, [](LbmRequest& r) -> Number& { return r.units.time_step; }),
      D::number(lbm::kMaxVelocityWord, [](LbmRequest& r) -> Number& { return r.units.largest_velocity; }),
      D::number(lbm::kMachWord, [](LbmRequest& r) -> Number& { return r.units.mach; }),
      D::choice(
          "precision", lbm::precision_words(), [](LbmRequest& r) -> lbm::Precision& { return r.precision; },
          lbm::kPrecisionMeaning),
      D::text(
          "region", "ID", [](LbmRequest& r) -> std::string& { return r.region; },
          "a block that the water fills instead of the whole box")};
  line.begin = [](ArgumentReader&, LbmRequest& r) {
    for (Number* asked : {&r.units.spacing, &r.units.relaxation_time, &r.units.time_step, &r.units.mach,
                          &r.units.largest_velocity})
      asked->reset();
  };
  line.finish = [](ArgumentReader&, const LbmRequest&, LbmRequest& r, const Given&) {
    const lbm::Units refuses_what_cannot_work(r.units);
    r.lattice_given = true;
  };
  return line;
}

Line boundary_line() {
  Line line{.name = "boundary", .meaning = "what happens at the box's faces", .noun = "face"};
  const std::string kinds = "periodic|noslip|freeslip|velocity VX VY VZ|pressure P";
  line.after = "FACE " + kinds + " ...";
  for (std::size_t f = 0; f < lbm::kFaces; ++f) {
    const std::string name = lbm::name_of(static_cast<lbm::Face>(f));
    line.words.push_back(
        {{name, kinds, "m/s, Pa", "", "noslip", "`periodic` by itself where LIGGGHTS's box is"},
         [f, name](ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, LbmRequest& r) {
           ScriptFace face;
           face.given = true;
           face.kind = choose(reader, "kind of " + name, lbm::face_kind_words());
           if (face.kind == lbm::FaceKind::velocity)
             face.velocity = ScriptVector::read(reader, lmp, "velocity");
           if (face.kind == lbm::FaceKind::pressure)
             face.pressure = ScriptValue::read(reader, lmp, "pressure");
           r.faces[f] = face;
         }});
    line.words.back().listed = true;
  }
  return line;
}

Line force_line() {
  Line line{.name = "force", .meaning = "what drives water and grains", .at_least_one = true};
  line.words = {
      D::vector(
          "gravity", "m/s²", [](LbmRequest& r) -> ScriptVector& { return r.gravity; },
          "weighs the water: buoyancy of the grains, pressures beyond the hydrostatic one"),
      D::vector(
          "pressure_gradient", "Pa/m", [](LbmRequest& r) -> ScriptVector& { return r.pressure_gradient; },
          "along the flow, as faces of pressure would drive it; in periodic boxes")};
  return line;
}

Line collision_line() {
  const auto operator_place = [](LbmRequest& r) -> lbm::CollisionOperator& {
    return r.collision.collision_operator;
  };
  Line line{.name = "collision", .meaning = "how populations of a cell relax"};
  line.only_before_run = line.only_resolved = true;
  line.first = {
      D::kept(D::choice("operator", lbm::collision_words(), operator_place, "collision operator"),
              [](const SettingsOfState& s) { return name_of(collision_of(s).collision_operator); })};
  line.words = {
      D::kept(D::number(lbm::kMagicWord, [](LbmRequest& r) -> double& { return r.collision.magic; }),
              [](const SettingsOfState& s) {
                const lbm::CollisionSettings collision = collision_of(s);
                return lbm::has_magic(collision.collision_operator) ? digits(collision.magic) : "none";
              }),
      D::kept(D::choice<bool>(
                  "incompressible", kYesNo, [](LbmRequest& r) -> bool& { return r.collision.incompressible; },
                  lbm::kIncompressibleMeaning),
              [](const SettingsOfState& s) { return word_of(collision_of(s).incompressible); })};
  line.finish = [](ArgumentReader& reader, const LbmRequest&, LbmRequest& r, const Given& given) {
    if (given.count("magic") != 0 && !lbm::has_magic(r.collision.collision_operator))
      throw_user_error({reader.who(), "magic", "given", "go with " + lbm::words_with_magic(),
                        "drop it, or write `lbm collision trt magic ...`"});
    if (!r.comoving_given) r.effects.comoving = Switch::off;  // as this line says
  };
  return line;
}

}  // namespace

std::vector<Command<LbmRequest>> commands_of_water() {
  return {method_line(),   preset_line(), fluid_line(),    lattice_line(),
          boundary_line(), force_line(),  collision_line()};
}

}  // namespace suffuse::coupling
