#include "fine_diameter.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace suffuse::coupling {

double fine_diameter(const GrainQuestions& questions, const GrainQuestions::Summary& grains) {
  constexpr int classes = 64;
  constexpr double share = 0.25;
  const double least = 2 * grains.smallest_radius, growth = grains.largest_radius / grains.smallest_radius;
  if (growth < 1 + 1e-9) return least;
  std::vector<double> bounds;
  for (int n = 1; n < classes; ++n) bounds.push_back(least * std::pow(growth, double(n) / classes));
  const std::vector<double> counts = questions.grains_by_size(bounds);
  std::vector<double> surfaces;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    const double middle = least * std::pow(growth, (static_cast<double>(n) + 0.5) / classes);
    surfaces.push_back(counts[n] * middle * middle);
  }
  double below = -share * std::accumulate(surfaces.begin(), surfaces.end(), 0.);
  for (std::size_t n = 0; n < bounds.size(); ++n)
    if ((below += surfaces[n]) >= 0) return n == 0 ? least : bounds[n - 1];  // the low end of the class
  return bounds.back();
}

}  // namespace suffuse::coupling
