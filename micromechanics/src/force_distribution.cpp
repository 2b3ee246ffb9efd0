#include "suffuse/micromechanics/force_distribution.h"

#include <cmath>

namespace suffuse::micromechanics {
namespace {

/// Calls `take` with the share, the normal and the tangential force, N, of every contact. They are computed
/// in each pass rather than kept: a long dump has millions.
template <class Take>
void for_each_force(const Packing& packing, Take take) {
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share > 0) take(share, normal_force(contact), tangential_force(contact));
  }
}

/// Adds a contact that is `part` of all to a density over its mean; returns `part` if it lies beyond the
/// bins.
double add_to_density(std::vector<double>& density, double force, double mean, double part,
                      const ForceBins& bins) {
  if (mean <= 0) return 0;
  if (force < 0) return 0;  // tension has no place among the bins
  const double bin = force / mean / bins.width;
  if (!(bin < bins.count)) return part;
  density[static_cast<std::size_t>(bin)] += part / bins.width;
  return 0;
}

}  // namespace

ForceDistribution force_distribution(const Packing& packing, const ForceBins& bins) {
  ForceDistribution result;
  result.normal.assign(static_cast<std::size_t>(bins.count), 0.0);
  result.tangential = result.normal;
  double count = 0;
  for_each_force(packing, [&](double share, double normal, double tangential) {
    count += share;
    result.mean_normal += share * normal;
    result.tensile_share += normal < 0 ? share : 0;
    result.mean_tangential += share * tangential;
  });
  if (count == 0) return result;
  result.mean_normal /= count;
  result.tensile_share /= count;
  result.mean_tangential /= count;
  double strong = 0, excess = 0, squares = 0;
  for_each_force(packing, [&](double share, double normal, double tangential) {
    const double part = share / count;
    result.normal_beyond += add_to_density(result.normal, normal, result.mean_normal, part, bins);
    result.tangential_beyond +=
        add_to_density(result.tangential, tangential, result.mean_tangential, part, bins);
    if (result.mean_normal <= 0) return;
    const double f = normal / result.mean_normal;
    squares += share * (f - 1) * (f - 1);
    if (f <= 1) return;
    strong += share;
    excess += share * (f - 1);
  });
  if (result.mean_normal <= 0) return result;
  if (excess > 0) result.tail_exponent = strong / excess;
  result.coefficient_of_variation = std::sqrt(squares / count);
  return result;
}

}  // namespace suffuse::micromechanics
