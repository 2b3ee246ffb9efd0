#include "grading/grading_table.h"

#include <fmt/format.h>

namespace suffuse::analysis {

void write_curve(SafeFile& file, const micromechanics::Grading& grading) {
  file.write("diameter_m,percent_finer\n");
  for (const auto& point : grading.curve())
    file.write(fmt::format("{},{}\n", point.diameter, 100 * point.finer));
}

void write_shape(SafeFile& file, const micromechanics::Grading& grading,
                 const micromechanics::StabilityLimits& limits) {
  const auto least = micromechanics::minimum_shape_ratio(grading, limits);
  file.write("diameter_m,finer_percent,interval_percent,searched_to_percent,limit_ratio\n");
  for (const auto& point : micromechanics::shape_curve(grading, 1))
    file.write(fmt::format("{},{},{},{},{}\n", point.diameter, 100 * point.finer, 100 * point.interval,
                           100 * least.finer_limit, limits.kenney_lau));
}

}  // namespace suffuse::analysis
