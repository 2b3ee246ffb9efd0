#include "verdict/sample_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "suffuse/common/error.h"
#include "suffuse/common/toml_file.h"

namespace suffuse::analysis {
namespace {

namespace files = std::filesystem;

constexpr std::array<const char*, 9> kKeys{"table_4_1",        "table_5_1", "state",  "friction_compression",
                                           "split_m",          "friction",  "grains", "contacts",
                                           "youngs_modulus_pa"};

/// The friction while compressing that the thesis takes for each state.
struct State {
  const char* name;
  double friction;
};
constexpr std::array<State, 3> kStates{{{"loose", 0.3}, {"medium", 0.1}, {"dense", 0.0}}};

class Table {
 public:
  Table(const std::string& path, std::string who) : path_(path), who_(std::move(who)) {
    try {
      table_ = read_toml(path, who_);
    } catch (const UserError& problem) {
      const std::string message = problem.what();
      throw UserError(message.starts_with(who_) ? message : who_ + ": " + message);
    }
    for (const auto& [key, value] : table_)
      if (std::find(kKeys.begin(), kKeys.end(), key.str()) == kKeys.end())
        complain(std::string(key.str()), "unknown", fmt::format("be one of {}", fmt::join(kKeys, ", ")));
  }

  std::string text(const char* key) const {
    if (!table_.contains(key)) return {};
    const auto value = table_[key].value<std::string>();
    if (!value || value->empty()) complain(key, "not a text", "be a text in quotes");
    return *value;
  }

  std::optional<double> number(const char* key) const {
    if (!table_.contains(key)) return std::nullopt;
    const auto value = table_[key].value<double>();
    if (!value || !std::isfinite(*value) || *value < 0) complain(key, "not a number", "be a number >= 0");
    return *value;
  }

  [[noreturn]] void complain(const std::string& what, const std::string& value,
                             const std::string& rule) const {
    throw_user_error({who_ + ": " + path_, what, value, rule, "see docs/analysis/suffuse-analyse.md"});
  }

 private:
  std::string path_, who_;
  toml::table table_;
};

std::string state_of(const Table& table) {
  const std::string name = table.text("state");
  const std::optional<double> friction = table.number("friction_compression");
  for (const State& state : kStates) {
    if (!name.empty() ? name == state.name : friction && std::abs(*friction - state.friction) < 1e-9)
      return state.name;
  }
  if (!name.empty()) table.complain("state", name, "be loose, medium or dense");
  if (friction)
    table.complain("friction_compression", fmt::format("{}", *friction), "be 0.3, 0.1 or 0, or give state");
  table.complain("state", "not there", "be loose, medium or dense, or be told by friction_compression");
}

}  // namespace

SampleFolder read_sample_folder(const std::string& folder, const std::string& who) {
  const Table table((files::path(folder) / "sample.toml").string(), who);
  SampleFolder sample;
  sample.folder = folder;
  sample.table_4_1 = table.text("table_4_1");
  sample.table_5_1 = table.text("table_5_1");
  if (sample.table_4_1.empty() && sample.table_5_1.empty())
    table.complain("table_4_1", "not there", "name the sample, or table_5_1 must");
  // A sample of somebody's own grading is in neither table.
  for (std::string* name : {&sample.table_4_1, &sample.table_5_1})
    if (*name == "none") name->clear();
  sample.state = state_of(table);
  sample.split = table.number("split_m");
  sample.friction = table.number("friction").value_or(sample.friction);
  sample.youngs_modulus = table.number("youngs_modulus_pa");
  const auto inside = [&](const std::string& name, const char* usual) {
    return (files::path(folder) / (name.empty() ? usual : name)).string();
  };
  sample.grains = inside(table.text("grains"), "*grains*.dump*");
  sample.contacts = inside(table.text("contacts"), "*contacts*.dump*");
  return sample;
}

std::vector<std::string> find_sample_folders(const std::vector<std::string>& roots, const std::string& who) {
  std::map<std::string, std::string> found;  // by its place, so that overlapping roots give each once
  const auto add = [&](const files::path& folder) {
    found.emplace(files::canonical(folder).string(), folder.lexically_normal().string());
  };
  for (const std::string& root : roots) {
    if (!files::is_directory(root))
      throw_user_error({who, "folder", root, "be a folder", "give folders of samples, or one above them"});
    if (files::exists(files::path(root) / "sample.toml")) add(root);
    const auto options = files::directory_options::skip_permission_denied;
    for (const auto& entry : files::recursive_directory_iterator(root, options))
      if (entry.is_regular_file() && entry.path().filename() == "sample.toml")
        add(entry.path().parent_path());
  }
  std::vector<std::string> folders;
  for (auto& [place, name] : found) folders.push_back(name);
  return folders;
}

}  // namespace suffuse::analysis
