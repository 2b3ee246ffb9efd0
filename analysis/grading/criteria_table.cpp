#include "grading/criteria_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "files/csv_cell.h"
#include "files/number_parser.h"
#include "grading/grading_file.h"
#include "grading/grading_names.h"
#include "grading/grain_snapshot.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {

namespace {

using micromechanics::CriterionResult;
using micromechanics::Grading;

std::string value_text(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.4g}", value);
}

}  // namespace

std::string criteria_text(const std::vector<CriterionResult>& results) {
  std::size_t name = 9, measure = 7, limit = 5;
  for (const CriterionResult& result : results) {
    name = std::max(name, result.criterion.size());
    measure = std::max(measure, result.measure.size());
    limit = std::max(limit, result.limit.size());
  }
  std::string text = fmt::format("{:<{}}  {:<{}}  {:>9}  {:<{}}  {:<14}  {}\n", "criterion", name, "measure",
                                 measure, "value", "limit", limit, "verdict", "source");
  for (const CriterionResult& result : results)
    text += fmt::format("{:<{}}  {:<{}}  {:>9}  {:<{}}  {:<14}  {}\n", result.criterion, name, result.measure,
                        measure, value_text(result.value), result.limit, limit, to_string(result.verdict),
                        result.source);
  text += "\n";
  for (const CriterionResult& result : results)
    if (!result.note.empty()) text += fmt::format("{}: {}\n", result.criterion, result.note);
  return text;
}

void write_criteria(SafeFile& file, const std::vector<CriterionResult>& results) {
  file.write("criterion,measure,value,limit,verdict,source,note\n");
  for (const CriterionResult& result : results)
    file.write(fmt::format("{},{},{},{},{},{},{}\n", csv_text(result.criterion), csv_text(result.measure),
                           std::isnan(result.value) ? std::string() : fmt::format("{}", result.value),
                           csv_text(result.limit), to_string(result.verdict), result.source,
                           csv_text(result.note)));
}

void set_limits(const std::vector<std::string>& words, const std::string& who,
                micromechanics::StabilityLimits& limits, micromechanics::ConstrictionLimits* constriction) {
  std::map<std::string_view, double*> known;
  for (const auto& one : micromechanics::limit_names()) known[one.name] = &(limits.*(one.member));
  if (constriction != nullptr)
    for (const auto& one : micromechanics::constriction_limit_names())
      known[one.name] = &(constriction->*(one.member));
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    double value = 0;
    if (equals == std::string::npos || !parse_number(word.substr(equals + 1), value) || !std::isfinite(value))
      throw_user_error({who, "--limit", word, "be name=number", "such as kezdi=5"});
    const auto found = known.find(word.substr(0, equals));
    if (found == known.end()) {
      std::string all;
      for (const auto& [name, limit] : known) all += fmt::format("{}{}", all.empty() ? "" : ", ", name);
      throw_user_error({who, "--limit", word, "name a limit", "one of " + all});
    }
    *found->second = value;
  }
}

Grading grading_of_file(const std::string& name, const std::string& who) {
  const std::string path = grading_path(name, who);
  if (!is_dump(path, who)) return read_grading(path, who);
  return Grading::from_grains(diameters_of(read_grain_snapshot(path, who, false)));
}

std::string grading_text(const Grading& grading) {
  const micromechanics::GradingIndices d = micromechanics::grading_indices(grading);
  const auto mm = [](double diameter) { return value_text(1e3 * diameter); };
  std::string text =
      fmt::format("sizes in mm: d5 {}, d10 {}, d15 {}, d30 {}, d50 {}, d60 {}, d85 {}, d90 {}\n", mm(d.d5),
                  mm(d.d10), mm(d.d15), mm(d.d30), mm(d.d50), mm(d.d60), mm(d.d85), mm(d.d90));
  text += fmt::format("Cu {}, Cc {}, Sauter's size {} mm; ", value_text(d.uniformity),
                      value_text(d.curvature), mm(d.sauter));
  if (const auto& gap = grading.gap())
    text += fmt::format("gap-graded: ratio {:.4g} ({:.4g} to {:.4g} mm), {:.3g} % fines\n", gap->ratio(),
                        1e3 * gap->finer_diameter, 1e3 * gap->coarser_diameter, 100 * gap->finer);
  else
    text += "continuously graded\n";
  if (grading.unknown_below() > 0) text += curve_end(grading) + ": what lies below is not defined (-)\n";
  return text;
}

}  // namespace suffuse::analysis
