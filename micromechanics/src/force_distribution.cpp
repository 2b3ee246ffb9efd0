#include "suffuse/micromechanics/force_distribution.h"

#include <cmath>

namespace suffuse::micromechanics {
namespace {

/// Calls `take` with the normal and the tangential force of every contact, N. They are computed in each pass
/// rather than kept: a long dump has millions.
template <class Take>
void for_each_force(const Packing& packing, Take take) {
  for (const Contact& contact : packing.contacts)
    if (is_counted(packing, contact)) take(normal_force(contact), tangential_force(contact));
}

/// Adds one of `count` contacts to a density over its mean; returns its share if it lies beyond the bins.
double add_to_density(std::vector<double>& density, double force, double mean, double count,
                      const ForceBins& bins) {
  if (mean <= 0) return 0;
  if (force < 0) return 0;  // tension has no place among the bins
  const double bin = force / mean / bins.width;
  if (!(bin < bins.count)) return 1 / count;
  density[static_cast<std::size_t>(bin)] += 1 / count / bins.width;
  return 0;
}

}  // namespace

ForceDistribution force_distribution(const Packing& packing, const ForceBins& bins) {
  ForceDistribution result;
  result.normal.assign(static_cast<std::size_t>(bins.count), 0.0);
  result.tangential = result.normal;
  double count = 0;
  for_each_force(packing, [&](double normal, double tangential) {
    count += 1;
    result.mean_normal += normal;
    result.tensile_share += normal < 0;
    result.mean_tangential += tangential;
  });
  if (count == 0) return result;
  result.mean_normal /= count;
  result.tensile_share /= count;
  result.mean_tangential /= count;
  double strong = 0, excess = 0, squares = 0;
  for_each_force(packing, [&](double normal, double tangential) {
    result.normal_beyond += add_to_density(result.normal, normal, result.mean_normal, count, bins);
    result.tangential_beyond +=
        add_to_density(result.tangential, tangential, result.mean_tangential, count, bins);
    if (result.mean_normal <= 0) return;
    const double f = normal / result.mean_normal;
    squares += (f - 1) * (f - 1);
    if (f <= 1) return;
    strong += 1;
    excess += f - 1;
  });
  if (result.mean_normal <= 0) return result;
  if (excess > 0) result.tail_exponent = strong / excess;
  result.coefficient_of_variation = std::sqrt(squares / count);
  return result;
}

}  // namespace suffuse::micromechanics
