#include "verdict/flow_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "files/number_parser.h"
#include "files/text_input.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/layers.h"

namespace suffuse::analysis {
namespace {

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t comma = std::min(line.find(',', start), line.size());
    std::string_view cell = line.substr(start, comma - start);
    while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
    while (!cell.empty() && cell.back() == ' ') cell.remove_suffix(1);
    cells.push_back(cell);
    start = comma + 1;
  }
  return cells;
}

char axis_of_record(const NumberTable& table) {
  for (const char axis : {'x', 'y', 'z'})
    if (table.find(fmt::format("hydraulic_gradient_{}", axis)) ||
        table.find(fmt::format("centre_of_grains_{}_m", axis)))
      return axis;
  return 'z';
}

constexpr const char* kOneRun =
    "give each run by itself; of a run that went on from a restart leave out what it did again";

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

NumberTable::NumberTable(const std::string& path, const std::string& who) : path_(path), who_(who) {
  TextInput file(path, who);
  std::string_view line;
  while (file.next_line(line)) {
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string_view> cells = cells_of(line);
    const std::string where = fmt::format("{}, line {}", path, file.line_number());
    if (names_.empty()) {
      for (const std::string_view cell : cells) names_.emplace_back(cell);
      for (std::size_t k = 0; k < names_.size(); ++k)
        if (std::find(names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(k), names_[k]) !=
            names_.begin() + static_cast<std::ptrdiff_t>(k))
          throw_user_error({who, where, fmt::format("{} twice", names_[k]), "name each column once", ""});
      columns_.resize(names_.size());
      continue;
    }
    if (cells.size() != names_.size())
      throw_user_error({who, where, fmt::format("{} values", cells.size()),
                        fmt::format("be {}, one a name of the first row", names_.size()),
                        "is the run still writing?"});
    for (std::size_t k = 0; k < cells.size(); ++k) {
      double value = 0;
      if (!parse_number(cells[k], value) || !std::isfinite(value))
        throw_user_error({who, fmt::format("{}, {}", where, names_[k]), fmt::format("'{}'", cells[k]),
                          "be a finite number", ""});
      if (names_[k] == "time_s" && !columns_[k].empty() && value < columns_[k].back())
        throw_user_error({who, fmt::format("{}, {}", where, names_[k]),
                          fmt::format("{:g} after {:g}", value, columns_[k].back()), "not go back", kOneRun});
      columns_[k].push_back(value);
    }
  }
  if (names_.empty() || columns_.front().empty())
    throw_user_error(
        {who, path, "no rows", "hold a row of names and rows of numbers", "give the file of `lbm monitor`"});
}

const std::vector<double>* NumberTable::find(std::string_view name) const {
  const auto at = std::find(names_.begin(), names_.end(), name);
  return at == names_.end() ? nullptr : &columns_[static_cast<std::size_t>(at - names_.begin())];
}

const std::vector<double>& NumberTable::column(std::string_view name) const {
  const std::vector<double>* found = find(name);
  if (!found)
    throw_user_error({who_, path_, fmt::format("no column {}", name), "have it",
                      "give the file of `lbm monitor` with superficial_velocity, layer_gradient and bed"});
  return *found;
}

const std::vector<double>& NumberTable::rising_column(std::string_view name) const {
  const std::vector<double>& values = column(name);
  const auto back = std::adjacent_find(values.begin(), values.end(), std::greater<>());
  if (back != values.end())
    throw_user_error({who_, fmt::format("{}, {}", path_, name),
                      fmt::format("{:g} after {:g}", back[1], *back), "not go back", kOneRun});
  return values;
}

std::vector<const std::vector<double>*> NumberTable::numbered(std::string_view prefix) const {
  std::vector<const std::vector<double>*> found;
  while (const auto* next = find(fmt::format("{}{}", prefix, found.size() + 1))) found.push_back(next);
  return found;
}

FlowRecord flow_record(const NumberTable& table, const std::string& who, std::optional<double> height) {
  FlowRecord record;
  record.axis = axis_of_record(table);
  const auto& time = table.column("time_s");
  const auto& velocity = table.column(fmt::format("superficial_velocity_{}_m_per_s", record.axis));
  table.column("hydraulic_gradient_layer_1");
  const auto gradients = table.numbered("hydraulic_gradient_layer_");
  const std::size_t layers = gradients.size();
  const auto* centre = table.find(fmt::format("centre_of_grains_{}_m", record.axis));
  if (!centre) centre = &table.column("bed_height_m");
  auto stresses = table.numbered("vertical_stress_pa_");
  record.stress_in_pa = stresses.size() == layers;
  if (!record.stress_in_pa) stresses = table.numbered("effective_stress_ratio_");
  if (stresses.size() != layers) stresses.clear();

  for (std::size_t k = 0; k < table.rows(); ++k) {
    micromechanics::FlowState state{time[k], velocity[k], (*centre)[k], {}, {}};
    for (const auto* column : gradients) state.gradient.push_back((*column)[k]);
    for (const auto* column : stresses) state.stress.push_back((*column)[k]);
    record.states.push_back(std::move(state));
  }
  const auto* driving = table.find("applied_gradient");
  record.has_driving = driving != nullptr;
  for (std::size_t k = 0; k < table.rows(); ++k)
    record.driving.push_back(driving ? (*driving)[k]
                                     : micromechanics::bed_gradient(record.states[k].gradient));

  const auto porosities = table.numbered("porosity_layer_");
  if (porosities.size() == layers)
    for (const auto* column : porosities) record.layer_porosity.push_back(column->front());
  if (const auto* bed = table.find("bed_porosity"))
    record.porosity = bed->front();
  else if (!record.layer_porosity.empty())
    record.porosity = mean_of(record.layer_porosity);
  else
    table.column("bed_porosity");
  if (!(record.porosity > 0 && record.porosity < 1))
    throw_user_error({who, fmt::format("{}, porosity at rest", table.path()),
                      fmt::format("{:g}", record.porosity), "be between 0 and 1", ""});
  record.height = height ? *height : table.column("bed_height_m").front();
  if (!(record.height > 0))
    throw_user_error({who, fmt::format("{}, height of the bed", table.path()),
                      fmt::format("{:g}", record.height), "be > 0", ""});
  if (const auto* layers_height = table.find("layers_height_m"); layers_height && layers_height->front() > 0)
    record.solids_over_layers = (1 - record.porosity) * table.column("bed_height_m").front() /
                                micromechanics::kBedShare / layers_height->front();
  if (const auto* floor = table.find("layers_floor_m")) record.layers_on_floor = !(floor->front() > 0);
  return record;
}

std::optional<LayerVariance> layer_variance(const FlowRecord& record) {
  std::vector<double> ratios;
  for (const double porosity : record.layer_porosity) ratios.push_back(porosity / (1 - porosity));
  if (ratios.size() < 3) return std::nullopt;
  // The void ratio of layers of equal volume together, from their mean share of solids.
  const auto together = [](std::span<const double> e) {
    double solids = 0;
    for (const double ratio : e) solids += 1 / (1 + ratio) / static_cast<double>(e.size());
    return 1 / solids - 1;
  };
  const std::span<const double> upper(ratios.data(), ratios.size() - 1);
  return LayerVariance{micromechanics::void_ratio_variance(ratios, together(ratios)),
                       micromechanics::void_ratio_variance(upper, together(upper))};
}

}  // namespace suffuse::analysis
