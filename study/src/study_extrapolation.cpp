#include "suffuse/study/study_extrapolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/csv_cell.h"
#include "files/record_table.h"
#include "suffuse/study/study_table.h"

namespace suffuse::study {
namespace {

double spacing_of(const StudyRow& row, const StudyExtrapolationRule& rule) {
  for (const auto& [name, value] : row.run.swept)
    if (name == rule.variable) return rule.counts_cells ? 1 / std::stod(value) : std::stod(value);
  return 0;
}

std::string resolution_of(const StudyRow& row, const StudyExtrapolationRule& rule) {
  for (const auto& [name, value] : row.run.swept)
    if (name == rule.variable) return value;
  return "";
}

VariableValues others_of(const StudyRow& row, const StudyExtrapolationRule& rule) {
  VariableValues others;
  for (const auto& one : row.run.swept)
    if (one.first != rule.variable) others.push_back(one);
  return others;
}

void work_out(StudyExtrapolation& group, const Study& study, const std::vector<StudyRow>& rows) {
  std::vector<double> spacings;
  for (const std::size_t i : group.rows) spacings.push_back(spacing_of(rows[i], *study.extrapolate));
  std::vector<double> used_spacings;
  for (const std::size_t k : runs_to_extrapolate(spacings)) {
    group.used.push_back(group.rows[k]);
    used_spacings.push_back(spacings[k]);
    const std::string resolution = resolution_of(rows[group.rows[k]], *study.extrapolate);
    group.resolutions =
        group.resolutions.empty() ? resolution : fmt::format("{} {}", group.resolutions, resolution);
  }
  for (std::size_t q = 0; q < study.quantities.size(); ++q) {
    std::vector<GridResult> results;
    for (std::size_t k = 0; k < group.used.size(); ++k)
      if (const auto value = rows[group.used[k]].values[q]) results.push_back({used_spacings[k], *value});
    group.of_quantities.push_back(extrapolate(results, study.extrapolate->order));
  }
}

}  // namespace

std::vector<StudyExtrapolation> extrapolations(const Study& study, const std::vector<StudyRow>& rows) {
  std::vector<StudyExtrapolation> groups;
  if (!study.extrapolate) return groups;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].record.status != RunRecord::Status::finished) continue;
    const VariableValues others = others_of(rows[i], *study.extrapolate);
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const StudyExtrapolation& group) {
      return others_of(rows[group.rows.front()], *study.extrapolate) == others;
    });
    (known == groups.end() ? groups.emplace_back() : *known).rows.push_back(i);
  }
  for (StudyExtrapolation& group : groups) work_out(group, study, rows);
  return groups;
}

std::string extrapolation_titles(const Study& study) {
  if (!study.extrapolate) return "";
  std::string titles;
  for (const StudyQuantity& quantity : study.quantities)
    titles += fmt::format(",{0}_extrapolated,{0}_error_bar,{0}_order,{0}_convergence",
                          analysis::csv_text(quantity.name));
  return titles + ",extrapolated_from";
}

std::string extrapolation_cells(const Study& study, const std::vector<StudyExtrapolation>& groups,
                                std::size_t row) {
  if (!study.extrapolate) return "";
  const auto group = std::find_if(groups.begin(), groups.end(), [&](const StudyExtrapolation& one) {
    return std::find(one.rows.begin(), one.rows.end(), row) != one.rows.end();
  });
  if (group == groups.end()) return std::string(4 * study.quantities.size() + 1, ',');
  std::string cells;
  for (const GridConvergence& one : group->of_quantities)
    cells += fmt::format(",{},{},{},{}", one.value ? analysis::full_precision(*one.value) : "",
                         one.error_bar ? fmt::format("{:.6g}", *one.error_bar) : "",
                         one.observed_order ? fmt::format("{:.4g}", *one.observed_order) : "",
                         analysis::csv_text(to_string(one.kind)));
  return cells + fmt::format(",{}", group->resolutions);
}

std::string to_text(const GridConvergence& convergence) {
  if (!convergence.value) return fmt::format("no value: {}", to_string(convergence.kind));
  std::string text = fmt::format("{:.5g} ± {:.2g}", *convergence.value, *convergence.error_bar);
  if (convergence.observed_order) return text + fmt::format(" (order {:.2g})", *convergence.observed_order);
  return text + fmt::format(" ({})", to_string(convergence.kind));
}

}  // namespace suffuse::study
