#include "grading/constriction_table.h"

#include <fmt/format.h>

namespace suffuse::analysis {

using micromechanics::FractionBy;
using micromechanics::LoosePore;

const std::map<std::string, FractionBy>& fraction_names() {
  static const std::map<std::string, FractionBy> names{
      {"mass", FractionBy::mass}, {"number", FractionBy::number}, {"surface-area", FractionBy::surface_area}};
  return names;
}

const std::map<std::string, LoosePore>& pore_names() {
  static const std::map<std::string, LoosePore> names{{"inscribed", LoosePore::inscribed},
                                                      {"equal-area", LoosePore::equal_area}};
  return names;
}

void write_distribution(SafeFile& file, const micromechanics::ConstrictionOptions& options,
                        const std::optional<micromechanics::ConstrictionAnalysis>& analysis,
                        const std::optional<micromechanics::SizeDistribution>& packing) {
  std::map<std::string, micromechanics::ConstrictionSizes> sizes;
  std::string header = "percent_finer";
  if (analysis)
    for (const auto& [name, by] : fraction_names()) {
      sizes[name] = micromechanics::constriction_sizes(analysis->coarse, by, options.pore);
      const std::string column = name == "surface-area" ? "surface_area" : name;
      header += fmt::format(",dense_by_{0}_m,loose_by_{0}_m,at_density_by_{0}_m", column);
    }
  if (packing) header += ",packing_m";
  file.write(header + "\n");
  for (int percent = 0; percent <= 100; ++percent) {
    const double share = percent / 100.0;
    std::string row = fmt::format("{}", percent);
    for (const auto& [name, one] : sizes)
      row += fmt::format(",{},{},{}", one.dense.quantile(share), one.loose.quantile(share),
                         one.at(share, options.relative_density));
    if (packing) row += fmt::format(",{}", packing->quantile(share));
    file.write(row + "\n");
  }
}

void write_prediction(SafeFile& file, const micromechanics::Grading& grading,
                      micromechanics::ConstrictionOptions options,
                      const micromechanics::ConstrictionLimits& limits,
                      const micromechanics::StabilityLimits& stability) {
  file.write(
      "relative_density,split_percent_finer,controlling_constriction_m,largest_erodible_m,ratio,"
      "coordination_number,stress_reduction\n");
  for (int step = 0; step <= 20; ++step) {
    options.relative_density = step / 20.0;
    const auto one = micromechanics::analyse_constrictions(grading, options, limits, stability);
    file.write(fmt::format("{},{},{},{},{},{},{}\n", options.relative_density, 100 * one.split.finer,
                           one.controlling, one.largest_erodible, one.ratio(), one.coordination,
                           one.stress_reduction));
  }
}

}  // namespace suffuse::analysis
