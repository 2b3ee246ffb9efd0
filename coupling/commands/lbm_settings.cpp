#include "lbm_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "../liggghts/instance.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/coupling/automatic_coefficient.h"

namespace suffuse::coupling {

namespace {

/// The next word by its meaning; a UserError that lists the words if it has none.
template <class Meaning>
Meaning choose(ArgumentReader& reader, const std::string& what,
               const std::vector<std::pair<std::string, Meaning>>& words) {
  std::string known;
  for (const auto& [word, meaning] : words) known += (known.empty() ? "" : ", ") + word;
  const std::string given = reader.word(what + " (" + known + ")");
  for (const auto& [word, meaning] : words)
    if (word == given) return meaning;
  throw_user_error({reader.who(), what, given, "be one of: " + known, ""});
}

const std::vector<std::pair<std::string, bool>> kYesNo{{"yes", true}, {"no", false}};
const std::vector<std::pair<std::string, Switch>> kSwitch{
    {"on", Switch::on}, {"off", Switch::off}, {"auto", Switch::automatic}};

double positive_within(ArgumentReader& reader, const std::string& what, double least, double most) {
  const double value = reader.positive(what);
  if (value < least || value > most)
    throw_user_error(
        {reader.who(), what, fmt::format("{:g}", value),
         least > 0 ? fmt::format("be {:g} to {:g}", least, most) : fmt::format("be at most {:g}", most), ""});
  return value;
}

void refuse_repeated(const ArgumentReader& reader, const std::string& word, bool given) {
  if (given) throw_user_error({reader.who(), word, "given twice", "be given once", "drop one of the lines"});
}

}  // namespace

void read_preset(ArgumentReader& reader, LbmSettings& settings) {
  enum class Preset { thesis, thesis_appendix, standard };
  const auto preset = choose<Preset>(reader, "preset",
                                     {{"thesis", Preset::thesis},
                                      {"thesis_appendix", Preset::thesis_appendix},
                                      {"default", Preset::standard}});
  const CoupledSettings standard;
  auto& coupled = settings.coupled;
  coupled.fluid.collision = standard.fluid.collision;
  coupled.solids = standard.solids;
  coupled.effects = standard.effects;
  settings.comoving_given = false;
  coupled.average_force = standard.average_force;
  coupled.virtual_mass = standard.virtual_mass;
  if (preset == Preset::standard) return;
  // Thesis sections 3.3 and 3.4, Appendix C: one relaxation time, SC1, 5 x 5 x 5 sub-cells, no lubrication.
  // The text weights cells after Noble and Torczynski (eq 3.34); the appendix includes LBDEMcoupling's
  // headers without the switch that turns this on, and B is the solid fraction then.
  coupled.fluid.collision.collision_operator = lbm::CollisionOperator::bgk;
  coupled.solids.cells.solid_operator = lbm::SolidOperator::sc1;
  coupled.solids.cells.weighting =
      preset == Preset::thesis ? lbm::SolidWeighting::noble_torczynski : lbm::SolidWeighting::fraction;
  coupled.solids.automatic_coefficient = false;
  coupled.solids.fraction = FractionMethod::subcells;
  coupled.solids.subcells = 5;
  coupled.effects.turbulence = Switch::off;
  coupled.effects.lubrication = Switch::off;
  coupled.virtual_mass = 0;
}

void read_method(ArgumentReader& reader, LbmSettings& settings) {
  if (settings.lattice_given)
    throw_user_error({reader.who(), "line", "after lbm lattice", "come before it",
                      "what a spacing and a step may be depends on the method"});
  const bool averaged = choose<bool>(reader, "method", {{"resolved", false}, {"averaged", true}});
  std::optional<AveragedSettings> chosen;
  if (averaged) {
    chosen.emplace();
    std::vector<std::pair<std::string, DragLaw>> laws;
    for (const DragLawEntry& entry : drag_laws()) laws.emplace_back(entry.word, entry.law);
    while (!reader.done()) {
      if (reader.keyword("drag"))
        chosen->drag = choose<DragLaw>(reader, "drag", laws);
      else if (reader.keyword("graded"))
        chosen->graded = choose<bool>(reader, "graded", kYesNo);
      else
        reader.unknown(reader.word("keyword"), "drag, graded");
    }
  }
  settings.coupled.averaged = chosen;
  settings.coupled.units.only_cells_and_steps = averaged;
}

void read_fluid(ArgumentReader& reader, LbmSettings& settings) {
  lbm::UnitsRequest units = settings.coupled.units;
  while (!reader.done()) {
    if (reader.keyword("density"))
      units.density = reader.positive("density");
    else if (reader.keyword("viscosity"))
      units.viscosity = reader.positive("viscosity");
    else
      reader.unknown(reader.word("keyword"), "density, viscosity");
  }
  settings.coupled.units = units;
  settings.fluid_given = true;
}

void read_lattice(ArgumentReader& reader, LbmSettings& settings) {
  lbm::UnitsRequest units = settings.coupled.units;
  units.spacing.reset();
  units.relaxation_time.reset();
  units.time_step.reset();
  units.mach.reset();
  units.largest_velocity.reset();
  lbm::Precision precision = settings.coupled.fluid.precision;
  std::string region = settings.region;
  while (!reader.done()) {
    if (reader.keyword("spacing"))
      units.spacing = reader.positive("spacing");
    else if (reader.keyword("relaxation_time"))
      units.relaxation_time = reader.positive("relaxation_time");
    else if (reader.keyword("timestep"))
      units.time_step = reader.positive("timestep");
    else if (reader.keyword("max_velocity"))
      units.largest_velocity = reader.positive("max_velocity");
    else if (reader.keyword("mach"))
      units.mach = reader.positive("mach");
    else if (reader.keyword("precision"))
      precision = choose<lbm::Precision>(
          reader, "precision",
          {{"double", lbm::Precision::double_precision}, {"float", lbm::Precision::float_precision}});
    else if (reader.keyword("region"))
      region = reader.word("region");
    else
      reader.unknown(reader.word("keyword"),
                     "spacing, relaxation_time, timestep, max_velocity, mach, precision, region");
  }
  const lbm::Units check(units);  // refuses what cannot work
  settings.coupled.units = units;
  settings.coupled.fluid.precision = precision;
  settings.region = region;
  settings.lattice_given = true;
}

void read_boundary(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, LbmSettings& settings) {
  auto faces = settings.faces;
  std::array<bool, lbm::kFaces> named{};
  while (!reader.done()) {
    const auto face = choose<lbm::Face>(reader, "face",
                                        {{"xlo", lbm::Face::xlo},
                                         {"xhi", lbm::Face::xhi},
                                         {"ylo", lbm::Face::ylo},
                                         {"yhi", lbm::Face::yhi},
                                         {"zlo", lbm::Face::zlo},
                                         {"zhi", lbm::Face::zhi}});
    const auto index = static_cast<std::size_t>(face);
    refuse_repeated(reader, lbm::name_of(face), named[index]);
    named[index] = true;
    ScriptFace& f = faces[index];
    f = {};
    f.given = true;
    f.kind = choose<lbm::FaceKind>(reader, "kind of " + lbm::name_of(face),
                                   {{"periodic", lbm::FaceKind::periodic},
                                    {"noslip", lbm::FaceKind::no_slip},
                                    {"freeslip", lbm::FaceKind::free_slip},
                                    {"velocity", lbm::FaceKind::velocity},
                                    {"pressure", lbm::FaceKind::pressure}});
    if (f.kind == lbm::FaceKind::velocity) f.velocity = ScriptVector::read(reader, lmp, "velocity");
    if (f.kind == lbm::FaceKind::pressure) f.pressure = ScriptValue::read(reader, lmp, "pressure");
  }
  settings.faces = faces;
}

void read_force(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, LbmSettings& settings) {
  if (reader.done())
    throw_user_error({reader.who(), "keyword", "missing", "be gravity or pressure_gradient", ""});
  ScriptVector gravity = settings.gravity, gradient = settings.pressure_gradient;
  while (!reader.done()) {
    if (reader.keyword("gravity"))
      gravity = ScriptVector::read(reader, lmp, "gravity");
    else if (reader.keyword("pressure_gradient"))
      gradient = ScriptVector::read(reader, lmp, "pressure_gradient");
    else
      reader.unknown(reader.word("keyword"), "gravity, pressure_gradient");
  }
  settings.gravity = gravity;
  settings.pressure_gradient = gradient;
}

void read_collision(ArgumentReader& reader, LbmSettings& settings) {
  lbm::CollisionSettings collision = settings.coupled.fluid.collision;
  collision.collision_operator = choose(reader, "operator", lbm::collision_words());
  while (!reader.done()) {
    if (reader.keyword("magic")) {
      if (!lbm::has_magic(collision.collision_operator))
        throw_user_error({reader.who(), "magic", "given", "go with " + lbm::words_with_magic(),
                          "drop it, or write `lbm collision trt magic ...`"});
      collision.magic = reader.positive("magic");
    } else if (reader.keyword("incompressible"))
      collision.incompressible = choose<bool>(reader, "incompressible", kYesNo);
    else
      reader.unknown(reader.word("keyword"), "magic, incompressible");
  }
  settings.coupled.fluid.collision = collision;
  if (!settings.comoving_given) settings.coupled.effects.comoving = Switch::off;  // as this line says
}

void read_solid(ArgumentReader& reader, LbmSettings& settings) {
  SolidSettings solids = settings.coupled.solids;
  (void)reader.accept("psm");
  bool coefficient_given = false;
  while (!reader.done()) {
    if (reader.keyword("operator")) {
      solids.cells.solid_operator = choose(reader, "operator", lbm::solid_words());
    } else if (reader.keyword("weighting")) {
      solids.cells.weighting = choose<lbm::SolidWeighting>(
          reader, "weighting",
          {{"fraction", lbm::SolidWeighting::fraction},
           {"noble_torczynski", lbm::SolidWeighting::noble_torczynski},
           {"viscosity_independent", lbm::SolidWeighting::viscosity_independent}});
    } else if (reader.keyword("coefficient")) {
      coefficient_given = true;
      solids.automatic_coefficient = reader.accept("auto");
      if (!solids.automatic_coefficient)
        solids.cells.coefficient = positive_within(reader, "coefficient", 1e-3, kLargestCoefficient);
    } else if (reader.keyword("fraction")) {
      solids.fraction = choose<FractionMethod>(reader, "fraction",
                                               {{"exact", FractionMethod::exact},
                                                {"linear", FractionMethod::linear},
                                                {"subcells", FractionMethod::subcells}});
      if (solids.fraction == FractionMethod::subcells && reader.next_is_number()) {
        const auto n = reader.positive_integer("subcells");
        if (n > 32)
          throw_user_error(
              {reader.who(), "subcells", fmt::format("{}", n), "be at most 32", "5 is the thesis's"});
        solids.subcells = static_cast<int>(n);
      }
    } else if (reader.keyword("remap")) {
      solids.remap_distance = positive_within(reader, "remap", 0, 0.1);
    } else {
      reader.unknown(reader.word("keyword"), "operator, weighting, coefficient, fraction, remap");
    }
  }
  const bool has_coefficient = solids.cells.weighting == lbm::SolidWeighting::viscosity_independent;
  if (!has_coefficient) {
    if (coefficient_given)
      throw_user_error({reader.who(), "coefficient", "given", "go with weighting viscosity_independent",
                        "drop it, or change the weighting"});
    solids.automatic_coefficient = false;
  } else if (!coefficient_given &&
             settings.coupled.solids.cells.weighting != lbm::SolidWeighting::viscosity_independent) {
    solids.automatic_coefficient = true;
  }
  settings.coupled.solids = solids;
}

void read_effect(ArgumentReader& reader, LbmSettings& settings) {
  EffectSettings effects = settings.coupled.effects;
  bool comoving_given = settings.comoving_given;
  while (!reader.done()) {
    if (reader.keyword("turbulence")) {
      effects.turbulence = choose<Switch>(reader, "turbulence", kSwitch);
      if (reader.next_is_number()) effects.smagorinsky = reader.positive("Smagorinsky constant");
    } else if (reader.keyword("comoving")) {
      effects.comoving = choose<Switch>(reader, "comoving", kSwitch);
      comoving_given = true;
    } else if (reader.keyword("lubrication")) {
      effects.lubrication = choose<Switch>(reader, "lubrication", kSwitch);
    } else if (reader.keyword("buoyancy")) {
      effects.buoyancy = choose<Switch>(reader, "buoyancy", kSwitch);
    } else if (reader.keyword("rotation")) {
      effects.rotation = choose<Switch>(reader, "rotation", kSwitch);
    } else {
      reader.unknown(reader.word("keyword"), "turbulence, comoving, lubrication, buoyancy, rotation");
    }
  }
  settings.coupled.effects = effects;
  settings.comoving_given = comoving_given;
}

void read_couple(ArgumentReader& reader, LbmSettings& settings) {
  int substeps = settings.coupled.substeps;
  bool average = settings.coupled.average_force;
  std::optional<double> virtual_mass = settings.coupled.virtual_mass;
  double largest_mach = settings.largest_mach;
  while (!reader.done()) {
    if (reader.keyword("substeps")) {
      constexpr std::int64_t most = 1000000;
      const std::int64_t n = reader.accept("auto") ? 0 : reader.positive_integer("substeps");
      if (n > most)
        throw_user_error({reader.who(), "substeps", fmt::format("{}", n), fmt::format("be at most {}", most),
                          "`auto` takes as many as the script's `timestep` needs"});
      substeps = static_cast<int>(n);
    } else if (reader.keyword("average_force")) {
      average = choose<bool>(reader, "average_force", kYesNo);
    } else if (reader.keyword("virtual_mass")) {
      if (reader.accept("auto")) {
        virtual_mass.reset();
      } else {
        virtual_mass = reader.number("virtual_mass");
        if (*virtual_mass < 0 || *virtual_mass > 100)
          throw_user_error({reader.who(), "virtual_mass", fmt::format("{:g}", *virtual_mass), "be 0 to 100",
                            "0.5 is that of a sphere; `auto` decides"});
      }
    } else if (reader.keyword("max_mach")) {
      largest_mach = positive_within(reader, "max_mach", 0, 1);
    } else {
      reader.unknown(reader.word("keyword"), "substeps, average_force, virtual_mass, max_mach");
    }
  }
  settings.coupled.substeps = substeps;
  settings.coupled.average_force = average;
  settings.coupled.virtual_mass = virtual_mass;
  settings.largest_mach = largest_mach;
}

void read_guard(ArgumentReader& reader, LbmSettings& settings) {
  GuardLimits limits = settings.guards;
  constexpr double most = 1e300;
  while (!reader.done()) {
    if (reader.keyword("density")) {
      limits.density = positive_within(reader, "density", 0, most);
    } else if (reader.keyword("motion")) {
      limits.motion = positive_within(reader, "motion", 0, most);
    } else if (reader.keyword("overlap")) {
      limits.overlap = positive_within(reader, "overlap", 0, most);
    } else if (reader.keyword("mass")) {
      limits.mass = positive_within(reader, "mass", 0, most);
    } else if (reader.keyword("momentum")) {
      limits.momentum = positive_within(reader, "momentum", 0, most);
    } else if (reader.keyword("lost")) {
      limits.stop_if_lost = choose<bool>(reader, "lost", {{"stop", true}, {"warn", false}});
    } else {
      reader.unknown(reader.word("keyword"), "density, motion, overlap, mass, momentum, lost");
    }
  }
  settings.guards = limits;
}

void read_monitor(ArgumentReader& reader, LbmSettings& settings) {
  const std::string id = reader.word("ID of the monitor");
  if (reader.accept("off")) {
    std::erase_if(settings.monitors, [&](const MonitorRequest& m) { return m.id == id; });
    return;
  }
  for (const MonitorRequest& other : settings.monitors)
    refuse_repeated(reader, "monitor " + id, other.id == id);
  const MonitorRequest monitor = read_monitor_request(reader, id);
  refuse_shared_files(reader, settings, {monitor.file});
  settings.monitors.push_back(monitor);
}

void read_output(ArgumentReader& reader, LbmSettings& settings) {
  OutputRequest output;
  bool grains_named = false;  // `contacts` brings them along
  output.id = reader.word("ID of the output");
  if (reader.accept("off")) {
    std::erase_if(settings.outputs, [&](const OutputRequest& o) { return o.id == output.id; });
    return;
  }
  for (const OutputRequest& other : settings.outputs)
    refuse_repeated(reader, "output " + output.id, other.id == output.id);
  std::map<std::string, lbm::Field> fields;
  std::string known = "every, file, ";
  for (const lbm::FieldFacts& facts : lbm::kFields) {
    fields[facts.word] = facts.field;
    known += facts.word + std::string(", ");
  }
  while (!reader.done()) {
    if (reader.keyword("every")) {
      output.every = reader.positive("every");
    } else if (reader.keyword("file")) {
      output.file = reader.word("file");
    } else {
      (void)reader.accept("fields");
      const std::string word = reader.word("field");
      if (word == "grains" || word == "contacts") {
        refuse_repeated(reader, word, word == "grains" ? grains_named : output.contacts);
        grains_named |= word == "grains";
        output.grains = true;
        output.contacts = output.contacts || word == "contacts";
      } else if (const auto field = fields.find(word); field != fields.end()) {
        refuse_repeated(
            reader, word,
            std::find(output.fields.begin(), output.fields.end(), field->second) != output.fields.end());
        output.fields.push_back(field->second);
      } else
        reader.unknown(word, known + "grains, contacts");
    }
  }
  if (output.every <= 0 || output.file.empty())
    throw_user_error({reader.who(), "output " + output.id, "incomplete", "have every and file",
                      "lbm output o every 1e-2 file bed.h5 velocity pressure solid_fraction grains"});
  if (output.fields.empty())
    output.fields = {lbm::Field::velocity, lbm::Field::pressure, lbm::Field::solid_fraction};
  if (std::filesystem::path(output.file).extension() == ".xdmf")
    throw_user_error(
        {reader.who(), "file", output.file, "be the HDF5 file", "FILE.xdmf comes beside FILE.h5"});
  refuse_shared_files(reader, settings, files_of(output));
  settings.outputs.push_back(output);
}

std::vector<std::string> files_of(const OutputRequest& output) {
  const std::filesystem::path path(output.file), stem = path.parent_path() / path.stem();
  std::vector<std::string> files{output.file, stem.string() + ".xdmf"};
  if (output.grains)
    files.insert(files.end(),
                 {stem.string() + "_grains" + path.extension().string(), stem.string() + "_grains.xdmf"});
  if (output.contacts) files.push_back(stem.string() + "_contacts.xdmf");
  return files;
}

std::vector<std::string> files_of(const CheckpointRequest& checkpoint) {
  std::vector<std::string> files;
  for (const char* end : {"", ".grains", ".1", ".2", ".new"}) files.push_back(checkpoint.file + end);
  return files;
}

void refuse_shared_files(const ArgumentReader& reader, const LbmSettings& settings,
                         const std::vector<std::string>& files) {
  std::map<std::string, std::string> taken;
  for (const MonitorRequest& monitor : settings.monitors)
    taken[one_name_of(monitor.file)] = "lbm monitor " + monitor.id;
  for (const OutputRequest& output : settings.outputs)
    for (const std::string& file : files_of(output)) taken[one_name_of(file)] = "lbm output " + output.id;
  if (settings.checkpoint)
    for (const std::string& file : files_of(*settings.checkpoint))
      taken[one_name_of(file)] = "lbm restart write";
  for (const std::string& file : files)
    if (const auto other = taken.find(one_name_of(file)); other != taken.end())
      throw_user_error({reader.who(), "file", file, fmt::format("not be that of `{}`", other->second),
                        "give each its own file"});
}

lbm::FaceConditions faces_now(const LbmSettings& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp) {
  lbm::FaceConditions faces;
  for (std::size_t f = 0; f < lbm::kFaces; ++f) {
    const ScriptFace& given = settings.faces[f];
    lbm::FaceCondition& face = faces[f];
    face.kind = given.kind;
    if (!given.given && is_periodic(lmp, static_cast<int>(f / 2))) face.kind = lbm::FaceKind::periodic;
    if (face.kind == lbm::FaceKind::velocity)
      face.velocity = units.velocity_to_lattice(given.velocity.now(lmp));
    if (face.kind == lbm::FaceKind::pressure)
      face.density = units.pressure_to_density_lattice(given.pressure.now(lmp));
  }
  return faces;
}

namespace {
/// `lattice`: cells a step, in each step.
void require_below(double most, const Vec3& lattice, const std::string& what, const Vec3& si,
                   const lbm::Units& units) {
  if (!(lattice.norm() < most))
    throw_user_error(
        {"lbm force", what, fmt::format("{:g} {:g} {:g}", si[0], si[1], si[2]),
         fmt::format("change velocities by less than {:g} cells a step in each step", most),
         fmt::format("use a timestep far below {:.3g} s, or a smaller value", units.time_step())});
}
}  // namespace

/// It moves grains by their buoyancy alone, so that much is allowed.
Vec3 gravity_now(const LbmSettings& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp) {
  const Vec3 si = settings.gravity.now(lmp);
  require_below(100, units.acceleration_to_lattice(si), "gravity", si, units);
  return si;
}

Vec3 pressure_gradient_now(const LbmSettings& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp) {
  const Vec3 si = settings.pressure_gradient.now(lmp);
  require_below(0.1, units.force_density_to_lattice(si), "pressure_gradient", si, units);
  return si;
}

bool values_change(const LbmSettings& settings) {
  for (const ScriptFace& face : settings.faces)
    if (face.velocity.changes() || face.pressure.changes()) return true;
  return settings.gravity.changes() || settings.pressure_gradient.changes();
}

}  // namespace suffuse::coupling
