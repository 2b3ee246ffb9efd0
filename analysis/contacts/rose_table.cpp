#include "contacts/rose_table.h"

#include <fmt/format.h>

#include "suffuse/common/safe_file.h"

namespace suffuse::analysis {

using namespace micromechanics;

std::vector<Rose> roses_of(const PlaneDistribution& plane, int order) {
  std::vector<Rose> roses{{"contact_density", "_per_rad", plane.contact_density(), {}},
                          {"normal_force_density", "_per_rad", plane.normal_force_density(), {}},
                          {"mean_normal_force", "_over_f0", plane.mean_normal_force(), {}},
                          {"mean_tangential_force", "_over_f0", plane.mean_tangential_force(), {}}};
  for (Rose& rose : roses)
    rose.fit = &rose == &roses.back() ? fit_harmonics_absolute(rose.values, order)
                                      : fit_harmonics(rose.values, order);
  return roses;
}

void write_rose(const std::string& path, const PlaneDistribution& plane, const std::vector<Rose>& roses,
                const std::string& who) {
  SafeFile file(path, who);
  std::string header = "angle_low_rad,angle_high_rad,contacts";
  for (const Rose& rose : roses) header += fmt::format(",{0}{1},{0}_fit{1}", rose.name, rose.unit);
  file.write(header + '\n');
  for (int bin = 0; bin < plane.bins(); ++bin) {
    const auto b = static_cast<std::size_t>(bin);
    std::string line =
        fmt::format("{},{},{}", bin * plane.width(), (bin + 1) * plane.width(), plane.contacts[b]);
    for (const Rose& rose : roses) line += fmt::format(",{},{}", rose.values[b], rose.fit(plane.centre(bin)));
    file.write(line + '\n');
  }
  file.commit();
}

}  // namespace suffuse::analysis
