#include "suffuse/micromechanics/force_distribution.h"

#include <cmath>

namespace suffuse::micromechanics {
namespace {

struct Density {
  std::vector<double> values;
  double beyond = 0;
};

Density density_of(const std::vector<double>& forces, double mean, const ForceBins& bins) {
  Density result{std::vector<double>(static_cast<std::size_t>(bins.count), 0.0)};
  if (mean <= 0) return result;
  const double one = 1 / static_cast<double>(forces.size());
  for (const double force : forces) {
    const double bin = force / mean / bins.width;
    if (bin < bins.count)
      result.values[static_cast<std::size_t>(bin)] += one / bins.width;
    else
      result.beyond += one;
  }
  return result;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

}  // namespace

ForceDistribution force_distribution(const Packing& packing, const ForceBins& bins) {
  std::vector<double> normal, tangential;
  for (const Contact& contact : packing.contacts) {
    if (!is_counted(packing, contact)) continue;
    normal.push_back(normal_force(contact));
    tangential.push_back(tangential_force(contact));
  }
  ForceDistribution result;
  result.mean_normal = mean_of(normal);
  result.mean_tangential = mean_of(tangential);
  Density n = density_of(normal, result.mean_normal, bins);
  Density t = density_of(tangential, result.mean_tangential, bins);
  result.normal = std::move(n.values);
  result.tangential = std::move(t.values);
  result.normal_beyond = n.beyond;
  result.tangential_beyond = t.beyond;
  if (result.mean_normal <= 0) return result;
  double strong = 0, excess = 0, squares = 0;
  for (const double force : normal) {
    const double f = force / result.mean_normal;
    squares += (f - 1) * (f - 1);
    if (f <= 1) continue;
    strong += 1;
    excess += f - 1;
  }
  if (excess > 0) result.tail_exponent = strong / excess;
  result.coefficient_of_variation = std::sqrt(squares / static_cast<double>(normal.size()));
  return result;
}

}  // namespace suffuse::micromechanics
