#include "verdict/result_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "files/record_table.h"
#include "suffuse/common/safe_file.h"

namespace suffuse::analysis {
namespace {

/// What a layer has, in the order of the table.
struct LayerColumn {
  const char *title, *quantity, *symbol, *unit, *format, *source;
  std::optional<double> LayerRow::*value;
};
constexpr LayerColumn kColumns[] = {
    {"n", "porosity at rest", "n", "-", "{:>12.4f}", "first sample", &LayerRow::porosity},
    {"Terzaghi", "critical gradient, Terzaghi", "i_cr", "-", "{:>12.4f}", "terzaghi1943",
     &LayerRow::terzaghi},
    {"local i_cr", "critical gradient, stress over the layer's gradient", "i_cr", "-", "{:>12.4f}",
     "haq, Fig. 6.3", &LayerRow::local},
    {"i_cr above", "critical gradient, stress over the gradient above", "i_cr", "-", "{:>12.4f}",
     "line of sigma' over i", &LayerRow::by_lifting},
    {"slope", "slope of sigma'/sigma'_0 over the layer's gradient", "-", "-", "{:>12.3f}", "haq, Fig. 6.3",
     &LayerRow::slope},
    {"k (m/s)", "conductivity", "k", "m/s", "{:>12.4e}", "line of v over i", &LayerRow::conductivity}};

bool any(const std::vector<LayerRow>& layers, const LayerColumn& column) {
  return std::any_of(layers.begin(), layers.end(),
                     [&](const LayerRow& row) { return (row.*column.value).has_value(); });
}

}  // namespace

void ResultRows::add(std::string quantity, std::string symbol, std::optional<double> value, std::string unit,
                     std::string source, std::string note) {
  if (value && !std::isfinite(*value)) value.reset();  // none, in every form
  rows_.push_back(
      {std::move(quantity), std::move(symbol), std::move(unit), std::move(source), std::move(note), value});
}

std::string ResultRows::text() const {
  std::size_t width = 0;
  for (const Row& row : rows_) width = std::max(width, row.quantity.size());
  std::string text;
  for (const Row& row : rows_) {
    const std::string value = row.value ? fmt::format("{:#.4g}", *row.value) : "-";
    std::string line = fmt::format("{:<{}} {:<4} = {:>10} {:<4} {:<22} {}", row.quantity, width, row.symbol,
                                   value, row.unit == "-" ? "" : row.unit, row.source, row.note);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  if (layers_.empty()) return text;
  text += "\nlayer";
  for (const LayerColumn& column : kColumns)
    if (any(layers_, column)) text += fmt::format("{:>12}", column.title);
  text += "   (1 on top)\n";
  for (const LayerRow& row : layers_) {
    text += fmt::format("{:>5}", row.layer);
    for (const LayerColumn& column : kColumns) {
      if (!any(layers_, column)) continue;
      const std::optional<double>& value = row.*column.value;
      text += value ? fmt::format(fmt::runtime(column.format), *value) : fmt::format("{:>12}", "-");
    }
    text += '\n';
  }
  return text;
}

void ResultRows::write_csv(const std::string& path, const std::string& who) const {
  SafeFile file(path, who + " --output");
  file.write("layer,quantity,symbol,value,unit,source,note\n");
  for (const Row& row : rows_) {
    const std::string quantity = row.quantity.substr(row.quantity.find_first_not_of(' '));
    file.write(fmt::format(",\"{}\",{},{},{},\"{}\",\"{}\"\n", quantity, row.symbol, number_cell(row.value),
                           row.unit, row.source, row.note));
  }
  for (const LayerRow& row : layers_)
    for (const LayerColumn& column : kColumns)
      if (any(layers_, column))
        file.write(fmt::format("{},\"{}\",{},{},{},\"{}\",\n", row.layer, column.quantity, column.symbol,
                               number_cell(row.*column.value), column.unit, column.source));
  file.commit();
}

void ResultRows::write_json(const std::string& path, const std::string& who) const {
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
  };
  nlohmann::json results = nlohmann::json::array(), layers = nlohmann::json::array();
  for (const Row& row : rows_)
    results.push_back({{"quantity", row.quantity.substr(row.quantity.find_first_not_of(' '))},
                       {"symbol", row.symbol},
                       {"value", number(row.value)},
                       {"unit", row.unit},
                       {"source", row.source},
                       {"note", row.note}});
  for (const LayerRow& row : layers_)
    layers.push_back({{"layer", row.layer},
                      {"porosity", number(row.porosity)},
                      {"critical_gradient_terzaghi", number(row.terzaghi)},
                      {"critical_gradient_local", number(row.local)},
                      {"critical_gradient_above", number(row.by_lifting)},
                      {"stress_slope", number(row.slope)},
                      {"conductivity_m_per_s", number(row.conductivity)}});
  SafeFile file(path, who + " --json");
  file.write(nlohmann::json{{"results", results}, {"layers", layers}}.dump(1) + '\n');
  file.commit();
}

}  // namespace suffuse::analysis
