#include "suffuse/lbm/flow_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <stdexcept>

#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/common/toml_file.h"
#include "suffuse/lbm/flow_words.h"
#include "suffuse/lbm/whole_cells.h"

namespace suffuse::lbm {

namespace {

/// The declared keys of a table of the file; those of the file itself are its tables.
std::vector<std::string> keys_of(const std::string& table) {
  std::vector<std::string> keys;
  for (const FlowTable& declared : flow_tables()) {
    if (table.empty() && declared.name.find('.') == std::string::npos) keys.push_back(declared.name);
    if (table == declared.name)
      for (const WordFacts& word : declared.words) keys.push_back(word.word);
  }
  return keys;
}

/// One table of the file, which knows its name for messages and refuses keys that are not declared.
class Section {
 public:
  /// A table of the file's root.
  Section(const std::string& file, const std::string& name, const toml::table& root)
      : Section(file, name, root.get(name), keys_of(name)) {}

  /// `node` null: the file has no such table, and everything in it its default.
  Section(const std::string& file, const std::string& name, const toml::node* node,
          std::vector<std::string> keys)
      : who_(file + " [" + name + "]"),
        keys_(std::move(keys)),
        table_(node == nullptr ? nullptr : node->as_table()) {
    if (node != nullptr && table_ == nullptr)
      throw_user_error(
          {file, name, "(another kind of value)", "be a table", fmt::format("write `[{}]`", name)});
    if (table_ == nullptr) return;
    for (const auto& [key, value] : *table_) {
      const std::string word(key.str());
      if (!is_declared(word))
        throw_user_error({who_, "key", word, fmt::format("be one of {}", fmt::join(keys_, ", ")), ""});
    }
  }

  const std::string& who() const { return who_; }
  bool given() const { return table_ != nullptr; }

  std::optional<double> finite_number(const char* key) const {
    const std::optional<double> value = get<double>(key, "be a number");
    if (value && !std::isfinite(*value)) refuse(key, *value, "be finite");
    return value;
  }
  std::optional<double> number(const NumberWord& word) const {
    const std::optional<double> value = finite_number(word.word);
    if (value && !word.range.holds(*value)) refuse(word.word, *value, word.range.rule().c_str());
    return value;
  }
  std::optional<std::string> text(const char* key) const {
    return get<std::string>(key, "be a text in quotes");
  }
  std::optional<bool> truth(const char* key) const { return get<bool>(key, "be true or false"); }

  std::optional<Vec3> vector(const char* key) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<std::vector<double>> values = numbers(node);
    if (!values || values->size() != 3)
      throw_user_error({who_, key, "(another value)", "be three finite numbers, [x, y, z]", ""});
    return Vec3((*values)[0], (*values)[1], (*values)[2]);
  }

  static std::optional<std::vector<double>> numbers(const toml::node* node) {
    const toml::array* array = node->as_array();
    if (array == nullptr) return std::nullopt;
    std::vector<double> values;
    for (const toml::node& element : *array) {
      const std::optional<double> value = element.value<double>();
      if (!value || !std::isfinite(*value)) return std::nullopt;
      values.push_back(*value);
    }
    return values;
  }

  const toml::node* find(const std::string& key) const {
    if (!is_declared(key)) throw std::logic_error("flow case: " + who_ + " has no word " + key);
    return table_ == nullptr ? nullptr : table_->get(key);
  }

  [[noreturn]] void refuse(const char* key, double value, const char* rule) const {
    throw_user_error({who_, key, fmt::format("{}", value), rule, ""});
  }

 private:
  template <class T>
  std::optional<T> get(const char* key, const char* rule) const {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<T> value = node->value<T>();
    if (!value) throw_user_error({who_, key, "(another kind of value)", rule, ""});
    return value;
  }

  bool is_declared(const std::string& key) const {
    return std::find(keys_.begin(), keys_.end(), key) != keys_.end();
  }

  std::string who_;
  std::vector<std::string> keys_;
  const toml::table* table_;
};

template <class Choice>
Choice choose(const Section& section, const char* key, const std::string& word,
              const std::vector<std::pair<std::string, Choice>>& choices) {
  std::string names;
  for (const auto& [name, choice] : choices) {
    if (name == word) return choice;
    names += (names.empty() ? "" : ", ") + name;
  }
  throw_user_error({section.who(), key, word, "be one of " + names, ""});
}

FlowFace read_face(const std::string& file, const Section& boundary, const std::string& name) {
  FlowFace face;
  const toml::node* node = boundary.find(name);
  if (node == nullptr) return face;
  if (const std::optional<std::string> word = node->value<std::string>()) {
    face.kind = choose(boundary, name.c_str(), *word, face_kind_words());
    if (face.kind == FaceKind::velocity || face.kind == FaceKind::pressure)
      throw_user_error({boundary.who(), name, *word, "come with a value",
                        fmt::format("{} = {{ kind = \"{}\", value = ... }}", name, *word)});
    return face;
  }
  if (node->as_table() == nullptr)
    throw_user_error(
        {boundary.who(), name, "(another kind of value)", "be a kind or { kind, value, ramp }", ""});
  const Section table(file, "boundary." + name, node, keys_of("boundary.FACE"));
  const std::string kind = table.text("kind").value_or("missing");
  face.kind = choose(table, "kind", kind, face_kind_words());
  const bool valued = face.kind == FaceKind::velocity || face.kind == FaceKind::pressure;
  if (valued != (table.find("value") != nullptr) || (!valued && table.find("ramp") != nullptr))
    throw_user_error({table.who(), "kind", kind, valued ? "come with a value" : "come without value and ramp",
                      "velocity takes [x, y, z] in m/s, pressure a number in Pa"});
  if (face.kind == FaceKind::velocity) face.velocity_si = *table.vector("value");
  if (face.kind == FaceKind::pressure) face.pressure_si = *table.finite_number("value");
  face.ramp = table.number(kRampWord).value_or(0);
  return face;
}

void read_lattice(const std::string& file, const toml::table& root, FlowCase& flow) {
  const Section fluid(file, "fluid", root);
  flow.units.density = fluid.number(kDensityWord).value_or(flow.units.density);
  flow.units.viscosity = fluid.number(kViscosityWord).value_or(flow.units.viscosity);
  const Section lattice(file, "lattice", root);
  flow.units.spacing = lattice.number(kSpacingWord);
  flow.units.relaxation_time = lattice.number(kRelaxationTimeWord);
  flow.units.time_step = lattice.number(kTimestepWord);
  flow.units.mach = lattice.number(kMachWord);
  flow.units.largest_velocity = lattice.number(kMaxVelocityWord);
  flow.units.pressure_difference = lattice.number(kPressureDifferenceWord);
  const std::optional<Vec3> size = lattice.vector("size");
  if (!size || !(size->minCoeff() > 0))
    throw_user_error({lattice.who(), "size", size ? "not positive" : "missing", "be three lengths in m", ""});
  flow.size = *size;
  flow.precision = choose<Precision>(lattice, "precision", lattice.text("precision").value_or("double"),
                                     precision_words());
  flow.collision.collision_operator = choose<CollisionOperator>(
      lattice, "collision", lattice.text("collision").value_or("trt"), collision_words());
  if (lattice.find(kMagicWord.word) != nullptr && !has_magic(flow.collision.collision_operator))
    throw_user_error({lattice.who(), "magic", "given", "go with " + words_with_magic(), "drop it"});
  flow.collision.magic = lattice.number(kMagicWord).value_or(flow.collision.magic);
  flow.collision.smagorinsky = lattice.number(kSmagorinskyWord).value_or(0);
  flow.collision.incompressible = lattice.truth("incompressible").value_or(false);
}

void read_spheres(const std::string& file, const toml::table& root, FlowCase& flow) {
  const Section solids(file, "solids", root);
  const toml::node* node = solids.find("spheres");
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr)
    throw_user_error({solids.who(), "spheres", "(another value)", "be a list of [x, y, z, radius]", ""});
  for (const toml::node& element : *array) {
    const std::optional<std::vector<double>> v = Section::numbers(&element);
    if (!v || v->size() != 4 || !((*v)[3] > 0))
      throw_user_error({solids.who(), "spheres", fmt::format("entry {}", flow.spheres.size() + 1),
                        "be [x, y, z, radius], finite, with a radius > 0", ""});
    flow.spheres.push_back({Vec3((*v)[0], (*v)[1], (*v)[2]), (*v)[3]});
  }
}

/// The file that a table writes: a UserError where the table is there and names none.
std::string file_name(const Section& section, const char* key) {
  const std::string name = section.text(key).value_or("");
  if (section.given() && name.empty())
    throw_user_error({section.who(), key, "missing", "name what is written", "or drop the table"});
  return name;
}

std::vector<Field> read_fields(const Section& output) {
  const toml::array* names = output.find("fields")->as_array();
  if (names == nullptr || names->empty())
    throw_user_error({output.who(), "fields", "(another value)", "be a list of names", ""});
  std::vector<std::pair<std::string, Field>> words;
  for (const FieldFacts& facts : kFields) words.emplace_back(facts.word, facts.field);
  std::vector<Field> fields;
  for (const toml::node& name : *names) {
    const std::string word = name.value<std::string>().value_or("");
    fields.push_back(choose(output, "fields", word, words));
    if (std::count(fields.begin(), fields.end(), fields.back()) > 1)
      throw_user_error({output.who(), "fields", word + " twice", "name each field once", ""});
  }
  return fields;
}

/// No two of the files that a run writes may be one.
void refuse_shared_files(const std::string& file, const FlowCase& flow) {
  std::vector<std::string> names{flow.monitor_file, flow.restart_write};
  if (flow.output) names.insert(names.end(), {flow.output->path, xdmf_beside(flow.output->path)});
  std::set<std::string> taken;
  for (const std::string& name : names)
    if (!name.empty() && !taken.insert(one_name_of(name)).second)
      throw_user_error({file, "file", name, "be written by one table only", "give each its own file"});
}

void read_files(const std::string& file, const toml::table& root, FlowCase& flow) {
  const Section monitor(file, "monitor", root);
  flow.monitor_file = file_name(monitor, "file");
  flow.monitor_every = monitor.number(kEveryWord).value_or(flow.time / 100);
  const Section output(file, "output", root);
  if (const std::string path = file_name(output, "file"); !path.empty()) {
    flow.output.emplace();
    flow.output->path = path;
    flow.output->append = output.truth("append").value_or(false);
    flow.output_every = output.number(kEveryWord).value_or(flow.time);
    if (output.find("fields") != nullptr) flow.output->fields = read_fields(output);
  }
  const Section restart(file, "restart", root);
  flow.restart_read = restart.text("read").value_or("");
  flow.restart_write = restart.text("write").value_or("");
  refuse_shared_files(file, flow);
}

}  // namespace

FlowCase read_flow_case(const std::string& path) {
  const toml::table root = read_toml(path, "suffuse-flow");
  const Section top(path, "top level", &root, keys_of(""));
  FlowCase flow;
  read_lattice(path, root, flow);
  const Section boundary(path, "boundary", root);
  for (std::size_t f = 0; f < kFaces; ++f)
    flow.faces[f] = read_face(path, boundary, name_of(static_cast<Face>(f)));
  const Section force(path, "force", root);
  flow.acceleration = force.vector("acceleration").value_or(Vec3::Zero());
  flow.pressure_gradient = force.vector("pressure_gradient").value_or(Vec3::Zero());
  flow.frequency = force.number(kFrequencyWord).value_or(0);
  read_spheres(path, root, flow);
  const Section run(path, "run", root);
  const std::optional<double> time = run.number(kTimeWord);
  if (!time) throw_user_error({run.who(), "time", "missing", "be > 0 s", ""});
  flow.time = *time;
  flow.until_steady = run.number(kUntilSteadyWord);
  if (flow.until_steady && *flow.until_steady >= 1)
    run.refuse("until_steady", *flow.until_steady, "be below 1: it is a share of the mean velocity");
  if (flow.until_steady && flow.frequency > 0)
    throw_user_error({run.who(), "until_steady", fmt::format("{}", *flow.until_steady),
                      "come without a frequency: a flow that swings does not become steady",
                      "drop one of them"});
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
