#include "suffuse/lbm/flow_case.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>

#include "suffuse/common/error.h"
#include "suffuse/lbm/whole_cells.h"

namespace suffuse::lbm {

namespace {

/// One table of the file, which knows its name for messages and refuses keys that nobody asks for.
class Section {
 public:
  Section(const std::string& file, const std::string& name, const toml::table* table,
          std::initializer_list<const char*> keys)
      : who_(file + " [" + name + "]"), table_(table) {
    if (table == nullptr) return;
    for (const auto& [key, value] : *table) {
      const std::string word(key.str());
      if (std::none_of(keys.begin(), keys.end(), [&](const char* k) { return word == k; }))
        throw_user_error({who_, "key", word, fmt::format("be one of {}", fmt::join(keys, ", ")), ""});
    }
  }

  const std::string& who() const { return who_; }

  std::optional<double> number(const char* key) const { return get<double>(key, "be a number"); }
  std::optional<std::string> text(const char* key) const {
    return get<std::string>(key, "be a text in quotes");
  }
  std::optional<bool> truth(const char* key) const { return get<bool>(key, "be true or false"); }

  std::optional<Vec3> vector(const char* key) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<std::vector<double>> values = numbers(node);
    if (!values || values->size() != 3)
      throw_user_error({who_, key, "(another value)", "be three numbers, [x, y, z]", ""});
    return Vec3((*values)[0], (*values)[1], (*values)[2]);
  }

  static std::optional<std::vector<double>> numbers(const toml::node* node) {
    const toml::array* array = node->as_array();
    if (array == nullptr) return std::nullopt;
    std::vector<double> values;
    for (const toml::node& element : *array) {
      const std::optional<double> value = element.value<double>();
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
    return values;
  }

  const toml::node* find(const char* key) const { return table_ == nullptr ? nullptr : table_->get(key); }

 private:
  template <class T>
  std::optional<T> get(const char* key, const char* rule) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<T> value = node->value<T>();
    if (!value) throw_user_error({who_, key, "(another kind of value)", rule, ""});
    return value;
  }

  std::string who_;
  const toml::table* table_;
};

template <class Choice>
Choice choose(const Section& section, const char* key, const std::string& word,
              const std::map<std::string, Choice>& choices) {
  const auto found = choices.find(word);
  if (found != choices.end()) return found->second;
  std::string names;
  for (const auto& [name, choice] : choices) names += (names.empty() ? "" : ", ") + name;
  throw_user_error({section.who(), key, word, "be one of " + names, ""});
}

const std::map<std::string, FaceKind> kFaceKinds{{"periodic", FaceKind::periodic},
                                                 {"noslip", FaceKind::no_slip},
                                                 {"freeslip", FaceKind::free_slip},
                                                 {"velocity", FaceKind::velocity},
                                                 {"pressure", FaceKind::pressure}};

FlowFace read_face(const std::string& file, const Section& boundary, const std::string& name) {
  FlowFace face;
  const toml::node* node = boundary.find(name.c_str());
  if (node == nullptr) return face;
  if (const std::optional<std::string> word = node->value<std::string>()) {
    face.kind = choose(boundary, name.c_str(), *word, kFaceKinds);
    if (face.kind == FaceKind::velocity || face.kind == FaceKind::pressure)
      throw_user_error({boundary.who(), name, *word, "come with a value",
                        fmt::format("{} = {{ kind = \"{}\", value = ... }}", name, *word)});
    return face;
  }
  const Section table(file, "boundary." + name, node->as_table(), {"kind", "value", "ramp"});
  if (node->as_table() == nullptr)
    throw_user_error(
        {boundary.who(), name, "(another kind of value)", "be a kind or { kind, value, ramp }", ""});
  face.kind = choose(table, "kind", table.text("kind").value_or(""), kFaceKinds);
  if (face.kind == FaceKind::velocity) face.velocity_si = table.vector("value").value_or(Vec3::Zero());
  if (face.kind == FaceKind::pressure) face.pressure_si = table.number("value").value_or(0);
  face.ramp = table.number("ramp").value_or(0);
  return face;
}

void read_lattice(const std::string& file, const toml::table& root, FlowCase& flow) {
  const Section fluid(file, "fluid", root["fluid"].as_table(), {"density", "viscosity"});
  flow.units.density = fluid.number("density").value_or(1000);
  flow.units.viscosity = fluid.number("viscosity").value_or(1e-6);
  const Section lattice(
      file, "lattice", root["lattice"].as_table(),
      {"size", "spacing", "relaxation_time", "timestep", "mach", "max_velocity", "pressure_difference",
       "precision", "collision", "magic", "smagorinsky", "incompressible"});
  flow.units.spacing = lattice.number("spacing");
  flow.units.relaxation_time = lattice.number("relaxation_time");
  flow.units.time_step = lattice.number("timestep");
  flow.units.mach = lattice.number("mach");
  flow.units.largest_velocity = lattice.number("max_velocity");
  flow.units.pressure_difference = lattice.number("pressure_difference");
  const std::optional<Vec3> size = lattice.vector("size");
  if (!size || !(size->minCoeff() > 0))
    throw_user_error({lattice.who(), "size", size ? "not positive" : "missing", "be three lengths in m", ""});
  flow.size = *size;
  flow.precision =
      choose<Precision>(lattice, "precision", lattice.text("precision").value_or("double"),
                        {{"double", Precision::double_precision}, {"float", Precision::float_precision}});
  flow.collision.collision_operator =
      choose<CollisionOperator>(lattice, "collision", lattice.text("collision").value_or("trt"),
                                {{"bgk", CollisionOperator::bgk},
                                 {"trt", CollisionOperator::trt},
                                 {"trt_comoving", CollisionOperator::trt_comoving},
                                 {"central_moments", CollisionOperator::central_moments}});
  flow.collision.magic = lattice.number("magic").value_or(flow.collision.magic);
  flow.collision.smagorinsky = lattice.number("smagorinsky").value_or(0);
  flow.collision.incompressible = lattice.truth("incompressible").value_or(false);
}

void read_spheres(const std::string& file, const toml::table& root, FlowCase& flow) {
  const Section solids(file, "solids", root["solids"].as_table(), {"spheres"});
  const toml::node* node = solids.find("spheres");
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr)
    throw_user_error({solids.who(), "spheres", "(another value)", "be a list of [x, y, z, radius]", ""});
  for (const toml::node& element : *array) {
    const std::optional<std::vector<double>> v = Section::numbers(&element);
    if (!v || v->size() != 4 || !((*v)[3] > 0))
      throw_user_error({solids.who(), "spheres", fmt::format("entry {}", flow.spheres.size() + 1),
                        "be [x, y, z, radius] with a radius > 0", ""});
    flow.spheres.push_back({Vec3((*v)[0], (*v)[1], (*v)[2]), (*v)[3]});
  }
}

void read_files(const std::string& file, const toml::table& root, FlowCase& flow) {
  const Section monitor(file, "monitor", root["monitor"].as_table(), {"file", "every"});
  flow.monitor_file = monitor.text("file").value_or("");
  flow.monitor_every = monitor.number("every").value_or(flow.time / 100);
  const Section output(file, "output", root["output"].as_table(), {"file", "every", "fields", "append"});
  if (const std::optional<std::string> path = output.text("file")) {
    flow.output.emplace();
    flow.output->path = *path;
    flow.output->append = output.truth("append").value_or(false);
    flow.output_every = output.number("every").value_or(flow.time);
    if (const toml::node* fields = output.find("fields")) {
      flow.output->fields.clear();
      if (fields->as_array() == nullptr)
        throw_user_error({output.who(), "fields", "(another value)", "be a list of names", ""});
      for (const toml::node& name : *fields->as_array())
        flow.output->fields.push_back(choose<Field>(output, "fields", name.value<std::string>().value_or(""),
                                                    {{"velocity", Field::velocity},
                                                     {"pressure", Field::pressure},
                                                     {"density", Field::density},
                                                     {"solid_fraction", Field::solid_fraction}}));
    }
  }
  const Section restart(file, "restart", root["restart"].as_table(), {"read", "write"});
  flow.restart_read = restart.text("read").value_or("");
  flow.restart_write = restart.text("write").value_or("");
}

toml::table parse(const std::string& path) {
  try {
    return toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    throw UserError(
        fmt::format("{}, line {}: {}", path, error.source().begin.line, std::string(error.description())));
  }
}

}  // namespace

FlowCase read_flow_case(const std::string& path) {
  const toml::table root = parse(path);
  const Section top(
      path, "top level", &root,
      {"fluid", "lattice", "boundary", "force", "solids", "run", "monitor", "output", "restart"});
  FlowCase flow;
  read_lattice(path, root, flow);
  const Section boundary(path, "boundary", root["boundary"].as_table(),
                         {"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"});
  for (std::size_t f = 0; f < kFaces; ++f)
    flow.faces[f] = read_face(path, boundary, name_of(static_cast<Face>(f)));
  const Section force(path, "force", root["force"].as_table(),
                      {"acceleration", "pressure_gradient", "frequency"});
  flow.acceleration = force.vector("acceleration").value_or(Vec3::Zero());
  flow.pressure_gradient = force.vector("pressure_gradient").value_or(Vec3::Zero());
  flow.frequency = force.number("frequency").value_or(0);
  read_spheres(path, root, flow);
  const Section run(path, "run", root["run"].as_table(), {"time", "until_steady"});
  const std::optional<double> time = run.number("time");
  if (!time || !(*time > 0))
    throw_user_error({run.who(), "time", time ? fmt::format("{}", *time) : "missing", "be > 0 s", ""});
  flow.time = *time;
  flow.until_steady = run.number("until_steady");
  read_files(path, root, flow);
  return flow;
}

Index3 cells_of(const FlowCase& flow, const Units& units) {
  return whole_cells(flow.size, units.spacing(), "fluid lattice");
}

FaceConditions faces_at(const FlowCase& flow, const Units& units, double time_si) {
  FaceConditions faces;
  for (std::size_t f = 0; f < kFaces; ++f) {
    const FlowFace& face = flow.faces[f];
    const double share = face.ramp > 0 ? std::clamp(time_si / face.ramp, 0., 1.) : 1.;
    faces[f] = {face.kind, units.velocity_to_lattice(Vec3(share * face.velocity_si)),
                units.pressure_to_density_lattice(share * face.pressure_si)};
  }
  return faces;
}

Vec3 force_at(const FlowCase& flow, const Units& units, double time_si) {
  const double share = flow.frequency > 0 ? std::cos(2 * std::numbers::pi * flow.frequency * time_si) : 1.;
  return share * (units.acceleration_to_lattice(flow.acceleration) +
                  units.force_density_to_lattice(flow.pressure_gradient));
}

}  // namespace suffuse::lbm
