#include "suffuse/study/study_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "suffuse/common/error.h"
#include "suffuse/common/script_variables.h"

namespace suffuse::study {
namespace {

constexpr std::size_t kLongestName = 120;  // of a folder; file systems take 255 bytes

std::optional<std::string> value_of(const VariableValues& values, const std::string& name) {
  for (const auto& [known, value] : values)
    if (known == name) return value;
  return std::nullopt;
}

std::string joined(const VariableValues& variables, const char* separator) {
  std::string text;
  for (const auto& [name, value] : variables) text += (text.empty() ? "" : separator) + name + '=' + value;
  return text;
}

/// A folder's name that a shell and LIGGGHTS take without quotes.
std::string folder_name(const VariableValues& swept) {
  std::string name;
  for (const auto& [variable, value] : swept) {
    name += (name.empty() ? "" : ",") + variable + '=';
    for (const char c : value) {
      const bool plain = std::isalnum(static_cast<unsigned char>(c)) ||
                         std::string_view("._+-").find(c) != std::string_view::npos;
      name += plain ? c : '_';
    }
  }
  const std::string exact = joined(swept, ",");
  if (name == exact && name.size() <= kLongestName) return name;
  return name.substr(0, kLongestName) + '-' + fingerprint_of(exact).substr(0, 8);  // no two values alike
}

StudyCase case_of(const Study& study, const std::vector<std::string>& names, const VariableValues& given) {
  StudyCase run;
  for (const std::string& name : names) {
    std::optional<std::string> value = value_of(given, name);
    if (!value) value = value_of(study.base, name);
    if (!value)
      throw_user_error({study.file, "[base] " + name, "not there", "be given",
                        "runs that do not sweep it need its value"});
    run.swept.emplace_back(name, *value);
  }
  run.name = folder_name(run.swept);
  return run;
}

/// Every combination of a block, the last variable fastest.
std::vector<VariableValues> combinations(const SweepBlock& block) {
  std::vector<VariableValues> all{{}};
  for (const auto& [name, values] : block) {
    std::vector<VariableValues> longer;
    for (const VariableValues& before : all)
      for (const std::string& value : values) {
        longer.push_back(before);
        longer.back().emplace_back(name, value);
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

std::vector<std::string> swept_names(const Study& study) {
  std::vector<std::string> names;
  for (const SweepBlock& block : study.sweeps)
    for (const auto& [name, values] : block)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::vector<StudyCase> study_cases(const Study& study) {
  const std::vector<std::string> names = swept_names(study);
  std::vector<VariableValues> wanted;
  if (study.one_at_a_time) wanted.push_back({});  // the base itself
  for (const SweepBlock& block : study.sweeps) {
    std::vector<SweepBlock> parts{block};
    if (study.one_at_a_time) {
      parts.clear();
      for (const auto& one : block) parts.push_back({one});
    }
    for (const SweepBlock& part : parts)
      for (VariableValues& values : combinations(part)) wanted.push_back(std::move(values));
  }
  std::vector<StudyCase> cases;
  const auto add = [&](StudyCase run) -> StudyCase& {
    for (StudyCase& known : cases)
      if (known.swept == run.swept) return known;
    return cases.emplace_back(std::move(run));
  };
  for (const VariableValues& values : wanted) add(case_of(study, names, values));
  if (!study.finest.empty()) add(case_of(study, names, study.finest)).is_reference = true;
  return cases;
}

std::string variables_text(const VariableValues& variables) {
  return joined(variables, ", ");
}

}  // namespace suffuse::study
