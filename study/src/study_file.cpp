#include "suffuse/study/study_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "files/csv_cell.h"
#include "files/number_parser.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/toml_file.h"
#include "suffuse/study/placeholder.h"

namespace suffuse::study {
namespace {

namespace files = std::filesystem;

/// A table of the file, and how its mistakes are told.
class Section {
 public:
  Section(std::string file, std::string name, const toml::table* table, std::vector<std::string> keys)
      : file_(std::move(file)), name_(std::move(name)), table_(table) {
    for (const auto& [key, value] : *table_)
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        complain(std::string(key.str()), "unknown", fmt::format("be one of {}", fmt::join(keys, ", ")));
  }

  bool has(const char* key) const { return table_->contains(key); }
  const toml::node* find(const char* key) const { return table_->get(key); }

  std::string text(const char* key, const std::string& otherwise = "") const {
    if (!has(key)) return otherwise;
    const toml::value<std::string>* value = find(key)->as_string();
    if (value == nullptr || value->get().empty()) complain(key, "no text", "be a text in quotes");
    return value->get();
  }

  double number(const char* key, double otherwise, double least) const {
    if (!has(key)) return otherwise;
    const std::optional<double> value = find(key)->value<double>();
    if (!value || !std::isfinite(*value)) complain(key, "no number", "be a number");
    if (*value < least) complain(key, fmt::format("{}", *value), fmt::format("be >= {}", least));
    return *value;
  }

  const toml::table& table(const char* key) const {
    const toml::table* found = find(key)->as_table();
    if (found == nullptr) complain(key, "no table", fmt::format("be a table, [{}]", key));
    return *found;
  }

  [[noreturn]] void complain(const std::string& what, const std::string& value,
                             const std::string& rule) const {
    throw_user_error({file_, name_.empty() ? what : fmt::format("[{}] {}", name_, what), value, rule,
                      "see docs/analysis/suffuse-study.md"});
  }

  const std::string& file() const { return file_; }

 private:
  std::string file_, name_;
  const toml::table* table_;
};

/// Keys in the order in which they stand in the file; toml++ sorts them by name.
std::vector<std::string> keys_in_order(const toml::table& table) {
  std::vector<std::pair<toml::source_position, std::string>> keys;
  for (const auto& [key, value] : table) keys.emplace_back(key.source().begin, key.str());
  std::sort(keys.begin(), keys.end());
  std::vector<std::string> names;
  for (auto& [place, name] : keys) names.push_back(std::move(name));
  return names;
}

/// A value as `-var` takes it; {study} in a text stands for the folder of the study file.
std::string value_text(const toml::node& node, const Section& section, const std::string& key) {
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* number = node.as_floating_point())
    if (std::isfinite(number->get())) return fmt::format("{}", number->get());
  const auto* text = node.as_string();
  if (text == nullptr || text->get().empty()) section.complain(key, "neither", "be a number or a text");
  return with_value(text->get(), "{study}", files::absolute(section.file()).parent_path().string());
}

VariableValues variables_of(const Section& root, const char* name) {
  VariableValues values;
  if (!root.has(name)) return values;
  const toml::table& table = root.table(name);
  const std::vector<std::string> keys = keys_in_order(table);
  const Section section(root.file(), name, &table, keys);
  for (const std::string& key : keys) values.emplace_back(key, value_text(*table.get(key), section, key));
  return values;
}

SweepBlock block_of(const Section& root, const toml::table& table) {
  SweepBlock block;
  const std::vector<std::string> keys = keys_in_order(table);
  const Section section(root.file(), "sweep", &table, keys);
  for (const std::string& key : keys) {
    std::vector<std::string> values;
    if (const toml::array* list = table.get(key)->as_array()) {
      for (const toml::node& value : *list) values.push_back(value_text(value, section, key));
    } else {
      values.push_back(value_text(*table.get(key), section, key));
    }
    if (values.empty()) section.complain(key, "an empty list", "have a value");
    if (std::set<std::string>(values.begin(), values.end()).size() != values.size())
      section.complain(key, fmt::format("{}", fmt::join(values, ", ")), "have each value once");
    block.emplace_back(key, std::move(values));
  }
  if (block.empty()) root.complain("sweep", "empty", "name a variable and its values");
  return block;
}

std::vector<SweepBlock> sweeps_of(const Section& root) {
  if (!root.has("sweep")) root.complain("[sweep]", "not there", "name variables and their values");
  if (const toml::table* one = root.find("sweep")->as_table()) return {block_of(root, *one)};
  const toml::array* several = root.find("sweep")->as_array();
  if (several == nullptr || !several->is_homogeneous<toml::table>())
    root.complain("sweep", "no table", "be a table, [sweep], or several, [[sweep]]");
  std::vector<SweepBlock> blocks;
  for (const toml::node& block : *several) blocks.push_back(block_of(root, *block.as_table()));
  return blocks;
}

analysis::CsvCell::Take take_of(const Section& section) {
  const std::string name = section.text("take", "last");
  const std::pair<const char*, analysis::CsvCell::Take> names[] = {
      {"last", analysis::CsvCell::Take::last},
      {"first", analysis::CsvCell::Take::first},
      {"largest", analysis::CsvCell::Take::largest},
      {"smallest", analysis::CsvCell::Take::smallest},
      {"mean", analysis::CsvCell::Take::mean}};
  for (const auto& [known, take] : names)
    if (name == known) return take;
  section.complain("take", name, "be last, first, largest, smallest or mean");
}

/// Without `column`: the `value` in the row of this `quantity`, as `report ... write` leaves it.
analysis::CsvCell cell_of(const Section& section, const std::string& name) {
  analysis::CsvCell cell;
  cell.file = section.text("file");
  if (cell.file.empty()) section.complain("file", "not there", "name a CSV file");
  cell.column = section.text("column", "value");
  cell.take = take_of(section);
  if (section.has("where")) {
    const toml::table& table = section.table("where");
    for (const std::string& key : keys_in_order(table))
      cell.where.emplace_back(key, value_text(*table.get(key), section, key));
  }
  if (!section.has("column")) cell.where.emplace_back("quantity", name);
  if (section.has("take") && !cell.where.empty())
    section.complain("take", section.text("take"), "go with a column alone, of which it takes one value");
  return cell;
}

void read_reference(const Section& section, const toml::node& node, StudyQuantity& quantity) {
  quantity.source = section.text("source");
  if (const auto* word = node.as_string()) {
    quantity.by_finest = word->get() == "finest";
    if (!quantity.by_finest)
      section.complain("reference", word->get(), "be a number, \"finest\" or a table with a file");
    return;
  }
  if (const toml::table* table = node.as_table()) {
    const Section reference(section.file(), "quantity.reference", table, {"file", "column", "where"});
    analysis::CsvCell cell = cell_of(reference, quantity.name);
    if (quantity.source.empty()) quantity.source = cell.file;
    cell.file = (files::path(section.file()).parent_path() / cell.file).string();
    quantity.reference = analysis::read_csv_cell(cell, section.file());
  } else {
    quantity.reference = section.number("reference", 0, -HUGE_VAL);
    if (quantity.source.empty())
      section.complain("source", "not there", "say where the reference " + quantity.name + " is from");
  }
  if (*quantity.reference == 0 || !std::isfinite(*quantity.reference))
    section.complain("reference", fmt::format("{}", *quantity.reference),
                     "differ from 0, as errors are relative");
}

std::vector<StudyQuantity> quantities_of(const Section& root) {
  const toml::array* list = root.has("quantity") ? root.find("quantity")->as_array() : nullptr;
  if (list == nullptr || list->empty() || !list->is_homogeneous<toml::table>())
    root.complain("[[quantity]]", "not there", "say what to read from a run");
  std::vector<StudyQuantity> quantities;
  for (const toml::node& node : *list) {
    const Section section(root.file(), "quantity", node.as_table(),
                          {"name", "file", "column", "where", "take", "reference", "source", "uncertainty"});
    StudyQuantity quantity;
    quantity.name = section.text("name");
    if (quantity.name.empty()) section.complain("name", "not there", "be given");
    quantity.cell = cell_of(section, quantity.name);
    quantity.uncertainty = section.number("uncertainty", 0, 0) / 100;
    if (const toml::node* reference = section.find("reference"))
      read_reference(section, *reference, quantity);
    quantities.push_back(std::move(quantity));
  }
  return quantities;
}

std::string script_of(const Section& section) {
  const std::string name = section.text("script");
  if (name.empty()) section.complain("script", "not there", "name a LIGGGHTS script");
  const files::path path = files::absolute(files::path(section.file()).parent_path() / name);
  if (!is_file(path)) section.complain("script", name, "be a file (its path begins at the study's folder)");
  return path.lexically_normal().string();
}

/// No name twice: they are columns of one table.
void require_one_of_each(const Section& root, const Study& study) {
  std::set<std::string> swept, names{"status", "reason", "wall_s",       "core_s", "other_cores",
                                     "error",  "front",  "is_reference", "notes",  "extrapolated_from"};
  for (const SweepBlock& block : study.sweeps)
    for (const auto& [name, values] : block) swept.insert(name);
  const auto take = [&](const std::string& name) {
    if (!names.insert(name).second) root.complain(name, "there twice", "be the name of one thing");
  };
  for (const std::string& name : swept) take(name);
  for (const auto& [name, value] : study.fixed) take(name);
  for (const StudyQuantity& quantity : study.quantities)
    for (const char* column :
         {"", "_reference", "_error", "_extrapolated", "_error_bar", "_order", "_convergence"})
      take(quantity.name + column);
  for (const auto& [name, value] : study.base)
    if (!swept.contains(name)) root.complain("[base] " + name, value, "be swept, or stand in [fixed]");
  for (const auto& [name, value] : study.finest)
    if (!swept.contains(name)) root.complain("[finest] " + name, value, "be swept, or stand in [fixed]");
  if (study.finest.size() != 0 && study.finest.size() != swept.size())
    root.complain("[finest]", fmt::format("{} variables", study.finest.size()),
                  fmt::format("give all that are swept: {}", fmt::join(swept, ", ")));
}

/// {prepare} is a folder only where something is prepared.
void require_no_preparation(const Section& root, const Study& study) {
  const auto look = [&](const std::string& name, const std::string& value) {
    if (value.find("{prepare}") != value.npos)
      root.complain(name, value, "go with a section [prepare], whose folder {prepare} stands for");
  };
  for (const auto& [name, value] : study.fixed) look(name, value);
  for (const auto& [name, value] : study.base) look(name, value);
  for (const auto& [name, value] : study.finest) look(name, value);
  for (const SweepBlock& block : study.sweeps)
    for (const auto& [name, values] : block)
      for (const std::string& value : values) look(name, value);
}

StudyExtrapolationRule extrapolation_of(const Section& root, const Study& study) {
  const Section section(root.file(), "extrapolate", &root.table("extrapolate"),
                        {"cells", "spacing", "order"});
  StudyExtrapolationRule rule;
  if (section.has("cells") == section.has("spacing"))
    section.complain("cells", "and spacing", "be given, one of both, with the name of a swept variable");
  rule.counts_cells = section.has("cells");
  const char* key = rule.counts_cells ? "cells" : "spacing";
  rule.variable = section.text(key);
  rule.order = section.number("order", rule.order, 0.5);
  bool is_swept = false;
  const auto require_size = [&](const std::string& name, const std::string& value) {
    if (name != rule.variable) return;
    double size = 0;
    if (!analysis::parse_number(value, size) || !(size > 0) || !std::isfinite(size))
      section.complain(key, name + " = " + value, "have numbers > 0 in all runs");
  };
  for (const SweepBlock& block : study.sweeps)
    for (const auto& [name, values] : block) {
      is_swept = is_swept || name == rule.variable;
      for (const std::string& value : values) require_size(name, value);
    }
  if (!is_swept) section.complain(key, rule.variable, "be a variable of [sweep]");
  for (const auto& [name, value] : study.base) require_size(name, value);
  for (const auto& [name, value] : study.finest) require_size(name, value);
  return rule;
}

}  // namespace

Study read_study(const std::string& path) {
  const toml::table table = read_toml(path, "suffuse-study");
  const Section root(path, "", &table,
                     {"title", "script", "ranks", "launcher", "time_limit", "within", "design", "fixed",
                      "base", "sweep", "finest", "quantity", "prepare", "extrapolate"});
  Study study;
  study.file = files::absolute(path).string();
  study.title = root.text("title", files::path(path).stem().string());
  study.script = script_of(root);
  const double ranks = root.number("ranks", 1, 1);
  if (ranks != std::floor(ranks) || ranks > 100000)
    root.complain("ranks", fmt::format("{}", ranks), "be a whole number up to 100000");
  study.ranks = static_cast<int>(ranks);
  if (root.has("launcher"))
    study.launcher = {root.text("launcher"), files::absolute(path).parent_path().string(), path, "launcher"};
  study.time_limit = root.number("time_limit", 0, 0);
  study.within = root.number("within", 3, 0) / 100;
  const std::string design = root.text("design", "grid");
  study.one_at_a_time = design == "one_at_a_time";
  if (!study.one_at_a_time && design != "grid") root.complain("design", design, "be grid or one_at_a_time");
  study.fixed = variables_of(root, "fixed");
  study.base = variables_of(root, "base");
  study.finest = variables_of(root, "finest");
  study.sweeps = sweeps_of(root);
  study.quantities = quantities_of(root);
  bool by_finest = false;
  for (const StudyQuantity& quantity : study.quantities) {
    by_finest = by_finest || quantity.by_finest;
    if (quantity.by_finest && study.finest.empty())
      root.complain("[finest]", "not there", "say which run is the reference of " + quantity.name);
  }
  if (!by_finest && !study.finest.empty())
    root.complain("[finest]", "given", "be the reference of a quantity: reference = \"finest\"");
  if (root.has("extrapolate")) study.extrapolate = extrapolation_of(root, study);
  require_one_of_each(root, study);
  if (root.has("prepare")) {
    const Section section(path, "prepare", &root.table("prepare"), {"script", "variables"});
    study.preparation = {script_of(section), variables_of(section, "variables")};
  } else {
    require_no_preparation(root, study);
  }
  return study;
}

}  // namespace suffuse::study
